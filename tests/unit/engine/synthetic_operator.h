// The engine over an operator that is no stored transport: nothing of it is light, pixels,
// tiles or files. Receivers in clusters answer to a curve of 256 bins, each by a lobe of its
// own, and the operator works out its values when they are asked for.
#pragma once

#include "protocol/transport/sketch_builder.h"
#include "server/engine/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace relume::engine::synthetic {

using transport::kBlockSize;
using transport::kColours;

inline constexpr std::uint32_t kBins = 256;
inline constexpr std::uint32_t kClusters = 5;
inline constexpr std::uint32_t kClusterSize = 60;
inline constexpr std::uint32_t kReceivers = kClusters * kClusterSize;

// Orthonormal Haar functions on the bins: 0 is constant, and band b ≥ 1 has 2^(b−1) functions.
inline std::uint32_t band_from_column(std::uint32_t column) {
    return static_cast<std::uint32_t>(std::bit_width(column));
}

inline basis::Bands curve_bands() {
    basis::Bands bands;
    for (std::uint32_t j = 0; j < kBins; ++j) {
        bands.of_coefficient.push_back(static_cast<std::uint8_t>(band_from_column(j)));
    }
    for (std::uint32_t band = 0; band <= band_from_column(kBins - 1); ++band) {
        bands.octaves.push_back(static_cast<float>(band));
    }
    return bands;
}

// A receiver's answer to the curve is a Gaussian lobe over the bins, dyed per colour.
class Lobes {
  public:
    Lobes() {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform;
        for (Lobe& lobe : lobes_) {
            lobe = {.centre = kBins * uniform(random),
                    .width = 2 + 40 * uniform(random),
                    .colour = {uniform(random), uniform(random), uniform(random)}};
        }
    }

    // T(receiver, colour, column), from the lobe's integral in closed form.
    [[nodiscard]] double value(std::uint32_t receiver,
                               std::size_t colour,
                               std::uint32_t column) const {
        const Lobe& lobe = lobes_[receiver];
        if (column == 0) {
            return lobe.colour[colour] * lobe.integral(0, kBins) / std::sqrt(double{kBins});
        }
        const std::uint32_t functions = std::bit_floor(column);
        const double length = double{kBins} / functions;
        const double begin = (column - functions) * length;
        const double middle = begin + length / 2;
        return lobe.colour[colour] *
               (lobe.integral(begin, middle) - lobe.integral(middle, begin + length)) /
               std::sqrt(length);
    }

  private:
    struct Lobe {
        double centre = 0;  // in bins
        double width = 1;
        std::array<double, kColours> colour{};

        [[nodiscard]] double integral(double from, double to) const {
            const auto part = [this](double at) { return std::erf((at - centre) / width); };
            return width * std::sqrt(std::numbers::pi) / 2 * (part(to) - part(from));
        }
    };

    std::array<Lobe, kReceivers> lobes_{};
};

// What a table of columns keeps references to.
struct Tables {
    std::vector<float> energies;
    std::vector<std::uint32_t> bytes;
    transport::SketchTable stating;
    transport::SketchTable choosing;

    explicit Tables(const Lobes& lobes)
        : energies(kColours * std::size_t{kBins}),
          bytes(kBins, kReceivers * kColours * sizeof(float)) {
        // Every cluster has rows of its own.
        const auto strata = transport::SketchStrata::several(256, kClusters);
        const transport::SketchPlan stating_plan(strata, 1);
        const transport::SketchPlan choosing_plan(strata, 2);
        stating = stating_plan.empty_table(kBins);
        choosing = choosing_plan.empty_table(kBins);
        transport::ColumnSketch stating_sketch(stating_plan);
        transport::ColumnSketch choosing_sketch(choosing_plan);
        for (std::uint32_t j = 0; j < kBins; ++j) {
            stating_sketch.clear();
            choosing_sketch.clear();
            for (std::size_t c = 0; c < kColours; ++c) {
                double energy = 0;
                for (std::uint32_t p = 0; p < kReceivers; ++p) {
                    const double value = lobes.value(p, c, j);
                    energy += value * value;
                    const std::uint32_t place =
                        p / kClusterSize * kBlockSize + p % kClusterSize;
                    stating_sketch.add(c, place, value);
                    choosing_sketch.add(c, place, value);
                }
                energies[j * kColours + c] = static_cast<float>(energy);
            }
            stating_sketch.store(j, stating);
            choosing_sketch.store(j, choosing);
        }
    }
};

// A cluster is a block, and a run; slots beyond its receivers stay zero.
class SyntheticOperator final : private Tables, public TransportOperator {
  public:
    explicit SyntheticOperator(const Lobes& lobes)
        : Tables(lobes),
          TransportOperator({.bands = curve_bands(),
                             .energies = energies,
                             .bytes = bytes,
                             .stating = stating.view(),
                             .choosing = choosing.view()},
                            kClusters),
          lobes_(lobes) {}

    [[nodiscard]] std::size_t run_count() const override { return kClusters; }
    [[nodiscard]] BlockRun run(std::size_t number) const override {
        return {.first = static_cast<std::uint32_t>(number), .count = 1};
    }
    void add(std::size_t run,
             std::span<const ColumnChange> changes,
             const RunSums& targets) const override {
        for (const ColumnChange& change : changes) {
            for_each_value(static_cast<std::uint32_t>(run), change.column,
                           [&](std::size_t c, std::size_t place, float value) {
                               targets.sums[place] += value * change.amount(c);
                               if (targets.total != nullptr) {
                                   targets.total[place] += value * change.amount(c);
                               }
                           });
        }
        if (targets.occupied != nullptr) {
            *targets.occupied = changes.empty() ? 0 : 1;
        }
    }
    void set_weights(std::span<const float> signal, Weights& weights) const override {
        weights.assign(signal.begin(), signal.end());
    }
    void multiply(std::uint32_t block,
                  std::uint32_t band,
                  std::span<const Member> members) const override {
        for (const std::uint32_t column : columns().of_band(band)) {
            for_each_value(block, column, [&](std::size_t c, std::size_t place, float value) {
                for (const Member& member : members) {
                    member.sums[place] += value * (*member.weights)[c * kBins + column];
                }
            });
        }
    }
    [[nodiscard]] std::uint32_t bands_of_block(std::uint32_t /*block*/) const override {
        return columns().all_bands();
    }
    [[nodiscard]] std::uint64_t product_bytes_of_block(std::uint32_t /*block*/) const override {
        return columns().total_bytes() / kClusters;
    }
    [[nodiscard]] std::uint64_t product_bytes() const override {
        return columns().total_bytes();
    }

  private:
    template <typename Visit>
    void for_each_value(std::uint32_t block, std::uint32_t column, const Visit& visit) const {
        for (std::size_t c = 0; c < kColours; ++c) {
            for (std::uint32_t slot = 0; slot < kClusterSize; ++slot) {
                visit(c, c * kBlockSize + slot,
                      static_cast<float>(lobes_.value(block * kClusterSize + slot, c, column)));
            }
        }
    }

    const Lobes& lobes_;
};

class SyntheticKind : public testing::Test {
  protected:
    [[nodiscard]] Session session(relighting::Method method) const {
        return {workspace_, {.method = method, .priority = relighting::Priority::transport}};
    }

    // The coefficients of a curve with a peak that moves along the bins over a slow slope.
    [[nodiscard]] static std::vector<float> peak_at(double bin) {
        std::array<double, kBins> curve{};
        for (std::uint32_t b = 0; b < kBins; ++b) {
            curve[b] = 0.2 + b / double{kBins} + 8 / (1 + 0.01 * (b - bin) * (b - bin));
        }
        std::vector<float> signal(kColours * std::size_t{kBins});
        for (std::uint32_t j = 0; j < kBins; ++j) {
            const double coefficient = inner_product(curve, j);
            for (std::size_t c = 0; c < kColours; ++c) {
                signal[c * kBins + j] =
                    static_cast<float>(coefficient * (1 + 0.3 * static_cast<double>(c)));
            }
        }
        return signal;
    }

    // ‖sums − T·signal‖ / ‖T·signal‖ over the receivers of the first clusters, T·signal in
    // double precision.
    [[nodiscard]] double error(std::span<const float> sums,
                               std::span<const float> signal,
                               std::uint32_t clusters = kClusters) const {
        double difference = 0;
        double norm = 0;
        for (std::uint32_t p = 0; p < clusters * kClusterSize; ++p) {
            for (std::size_t c = 0; c < kColours; ++c) {
                double wanted = 0;
                for (std::uint32_t j = 0; j < kBins; ++j) {
                    wanted += lobes_.value(p, c, j) * double{signal[c * kBins + j]};
                }
                const std::size_t block = p / kClusterSize;
                const double found =
                    double{sums[(block * kColours + c) * kBlockSize + p % kClusterSize]};
                difference += (found - wanted) * (found - wanted);
                norm += wanted * wanted;
            }
        }
        return std::sqrt(difference / norm);
    }

    static constexpr relighting::Budget kTerms{
        .milliseconds = std::nullopt, .coefficients = 12, .target_error = 0};

    Lobes lobes_;
    std::shared_ptr<const Workspace> workspace_ =
        std::make_shared<const Workspace>(std::make_shared<const SyntheticOperator>(lobes_));

  private:
    static double inner_product(std::span<const double> curve, std::uint32_t column) {
        if (column == 0) {
            double sum = 0;
            for (const double value : curve) {
                sum += value;
            }
            return sum / std::sqrt(double{kBins});
        }
        const std::uint32_t functions = std::bit_floor(column);
        const std::uint32_t length = kBins / functions;
        const std::uint32_t begin = (column - functions) * length;
        double sum = 0;
        for (std::uint32_t b = 0; b < length; ++b) {
            sum += b < length / 2 ? curve[begin + b] : -curve[begin + b];
        }
        return sum / std::sqrt(static_cast<double>(length));
    }
};

inline void run_to_rest(Session& session, const relighting::Budget& budget) {
    for (std::uint32_t step = 0; step < 2 * kBins && !session.exact(); ++step) {
        session.advance(budget);
    }
    ASSERT_TRUE(session.exact());
}

}  // namespace relume::engine::synthetic
