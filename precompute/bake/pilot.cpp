#include "precompute/bake/pilot.h"

#include "precompute/bake/colour_split.h"
#include "precompute/bake/light_model.h"
#include "protocol/basis/haar.h"
#include "protocol/transport/hash.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace relume::bake {
namespace {

// Relative L2 below which one channel under a tint is enough.
constexpr double kColourless = 1e-3;
constexpr float kStepGrowth = 0.7F;  // β
// Error of a lone light over that of [Ng03]: what hard shadows give for a third fewer bytes.
constexpr double kLoneLightExcess = 4.0 / 3;
constexpr std::size_t kMostPixels = 512;
constexpr std::uint64_t kSampleBytes = std::uint64_t{96} << 20U;

struct Pixel {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

// Pixels of the scene, spread evenly; fewer where their rows would not fit into memory.
std::vector<Pixel> pilot_pixels(const transport::TileGrid& image,
                                std::size_t row_bytes,
                                std::uint64_t seed) {
    const std::size_t wanted = std::clamp<std::size_t>(
        std::min<std::size_t>(static_cast<std::size_t>(kSampleBytes / row_bytes),
                              std::size_t{image.width} * image.height / 16),
        64, kMostPixels);
    const double spacing = std::max(
        1.0, std::sqrt(double(image.width) * image.height / static_cast<double>(wanted)));
    std::vector<Pixel> pixels;
    for (double top = 0; top < image.height; top += spacing) {
        for (double left = 0; left < image.width; left += spacing) {
            const std::uint64_t bits = transport::mix_bits(seed + pixels.size());
            const double dx = spacing * double(transport::unit_float(bits));
            const double dy = spacing * double(transport::unit_float(bits << 32U));
            pixels.push_back(
                {.x = std::min(static_cast<std::uint32_t>(left + dx), image.width - 1),
                 .y = std::min(static_cast<std::uint32_t>(top + dy), image.height - 1)});
        }
    }
    return pixels;
}

struct PilotRow {
    std::array<std::vector<float>, 3> channel;
    ChromaResidual chroma;
};

// Expected squared error of random rounding with a dead zone.
double rounding_error(float value, float step) {
    const float scaled = std::abs(value) / step;
    if (scaled < 0.5F) {
        return double{value} * value;
    }
    const float fraction = scaled - std::floor(scaled);
    return double{step} * step * double{fraction * (1 - fraction)};
}

class StepChooser {
  public:
    StepChooser(std::uint32_t face_resolution,
                std::uint32_t bits,
                const transport::ColourModel& colour,
                const std::vector<PilotRow>& rows)
        : face_resolution_(face_resolution), colour_(colour), rows_(rows) {
        const std::size_t count = basis::texel_count(face_resolution);
        light_energy_.resize(count);
        growth_.resize(count);
        for (std::size_t j = 0; j < count; ++j) {
            const auto band =
                static_cast<float>(basis::band_from_coefficient(face_resolution, j));
            light_energy_[j] = std::exp2(-2 * kNaturalFalloff * band);
            growth_[j] = std::exp2(kStepGrowth * band);
        }
        for (std::uint32_t k = 0; k < colour.channels; ++k) {
            double norm = 0;
            for (const auto& row : colour.matrix) {
                norm += double{row[k]} * row[k];
            }
            channel_scale_.push_back(static_cast<float>(std::sqrt(3 / norm)));
        }
        target_ = column_range_errors(bits);
        target_.lone_light *= kLoneLightExcess * kLoneLightExcess;
    }

    [[nodiscard]] std::vector<float> steps() const {
        const std::size_t count = growth_.size();
        const float scale = largest_within([&](float candidate) {
            return natural_error([&](std::size_t j) { return candidate * growth_[j]; }) <
                   target_.natural;
        });
        const float coarsest = largest_within([&](float step) {
            return lone_light_error([&](std::size_t) { return step; }) < target_.lone_light;
        });
        std::vector<float> steps(count * colour_.channels);
        for (std::size_t j = 0; j < count; ++j) {
            for (std::uint32_t k = 0; k < colour_.channels; ++k) {
                steps[j * colour_.channels + k] =
                    std::min(scale * growth_[j], coarsest) * channel_scale_[k];
            }
        }
        return steps;
    }

  private:
    struct SquaredErrors {
        double natural = 0;     // under natural light
        double lone_light = 0;  // of one texel lit alone, in the mean over texels
    };

    // What [Ng03]'s quantiser costs: 2^bits levels over the range of each column of the first
    // channel.
    SquaredErrors column_range_errors(std::uint32_t bits) {
        std::vector<float> steps(growth_.size(), 0.0F);
        for (const PilotRow& row : rows_) {
            for (std::size_t j = 0; j < steps.size(); ++j) {
                steps[j] = std::max(steps[j], std::abs(row.channel[0][j]));
            }
        }
        largest_ = *std::max_element(steps.begin(), steps.end());
        const auto levels = static_cast<float>((1U << (bits - 1)) - 1);
        for (float& range : steps) {
            range /= levels;
        }
        const auto step = [&](std::size_t j) { return steps[j]; };
        return {.natural = natural_error(step), .lone_light = lone_light_error(step)};
    }

    template <typename Step>
    [[nodiscard]] double natural_error(Step step) const {
        return squared_error(step, [&](std::size_t j) { return double{light_energy_[j]}; });
    }

    // A lone texel's coefficients have the same energy in every band.
    template <typename Step>
    [[nodiscard]] double lone_light_error(Step step) const {
        return squared_error(step, [](std::size_t) { return 1.0; });
    }

    template <typename Step, typename Energy>
    [[nodiscard]] double squared_error(Step step, Energy light_energy) const {
        return sum_over_rows([&](const PilotRow& row) {
            double total = 0;
            for (std::size_t j = 0; j < growth_.size(); ++j) {
                if (step(j) > 0) {
                    total += light_energy(j) * rounding_error(row.channel[0][j], step(j));
                }
            }
            return total;
        });
    }

    // The largest step that holds, of those from a billionth of the largest value to all of it.
    template <typename Holds>
    [[nodiscard]] float largest_within(Holds holds) const {
        constexpr float kRange = 0x1p-30F;
        constexpr int kHalvings = 16;
        float high = std::max(largest_, std::numeric_limits<float>::min() / kRange);
        float low = high * kRange;
        for (int i = 0; i < kHalvings; ++i) {
            const float middle = std::sqrt(low * high);
            (holds(middle) ? low : high) = middle;
        }
        return low;
    }

    template <typename Error>
    [[nodiscard]] double sum_over_rows(Error error_of) const {
        std::vector<double> errors(rows_.size());
        tbb::parallel_for(std::size_t{0}, rows_.size(),
                          [&](std::size_t i) { errors[i] = error_of(rows_[i]); });
        double total = 0;
        for (const double one : errors) {
            total += one;
        }
        return total;
    }

    std::uint32_t face_resolution_;
    const transport::ColourModel& colour_;
    const std::vector<PilotRow>& rows_;
    std::vector<float> light_energy_;  // by coefficient
    std::vector<float> growth_;        // 2^(β·band)
    std::vector<float> channel_scale_;
    float largest_ = 0;  // value in the first channel
    SquaredErrors target_;
};

}  // namespace

Quantisation plan_quantisation(const RowBaker& rows,
                               const TileWindow& window,
                               const transport::TileGrid& image,
                               const BakeParameters& parameters) {
    const std::size_t count = basis::texel_count(parameters.face_resolution);
    const std::vector<Pixel> pixels =
        pilot_pixels(image, count * sizeof(float), parameters.seed);
    std::vector<PilotRow> pilot(pixels.size());
    struct Scratch {
        CoefficientRow row;
        ChannelRow channels;
        RowBaker::Scratch rows;
    };
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
        Scratch& scratch = scratches.local();
        const auto [x, y] = pixels[i];
        rows.bake(window.trace(x, y), x, y, nullptr, scratch.row, scratch.rows);
        pilot[i].chroma = chroma_residual(scratch.row);
        // The first channel is the same in both models but for a tint of the whole row.
        split_colours(grey_model(), scratch.row, scratch.channels);
        pilot[i].channel[0] = scratch.channels.channel[0];
    });
    ChromaResidual chroma;
    for (const PilotRow& row : pilot) {
        chroma.residual += row.chroma.residual;
        chroma.energy += row.chroma.energy;
    }
    Quantisation plan;
    plan.chroma_residual = chroma.energy > 0 ? std::sqrt(chroma.residual / chroma.energy) : 0.0;
    plan.colour = plan.chroma_residual < kColourless ? grey_model() : luma_chroma_model();
    plan.steps =
        StepChooser(parameters.face_resolution, parameters.bits, plan.colour, pilot).steps();
    return plan;
}

}  // namespace relume::bake
