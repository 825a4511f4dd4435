#include "tests/lab/methods/band_filling.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

// A column's difference, and how large it is: Σ_c |L − L̃|.
struct Difference {
    double size = 0;
    engine::ColumnChange change;
};

double size_of(const engine::ColumnChange& change) {
    double size = 0;
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        size += std::abs(double{change.to[c]} - double{change.from[c]});
    }
    return size;
}

// The differences of one band, the largest first, of which the first `taken` are chosen.
struct Band {
    std::vector<Difference> differences;
    std::vector<double> left;  // [differences + 1], Σ of the sizes from each one on
    std::size_t taken = 0;

    [[nodiscard]] double error() const { return left[taken]; }
};

Band band_of(const served::Scene& scene,
             const engine::SignalState& lighting,
             std::uint32_t index) {
    Band band;
    for (const std::uint32_t column : scene.columns().of_band(index)) {
        const engine::ColumnChange change = lighting.difference(column);
        if (!change.is_nothing()) {
            band.differences.push_back({.size = size_of(change), .change = change});
        }
    }
    std::stable_sort(band.differences.begin(), band.differences.end(),
                     [](const Difference& a, const Difference& b) { return a.size > b.size; });
    band.left.assign(band.differences.size() + 1, 0.0);
    for (std::size_t i = band.differences.size(); i > 0; --i) {
        band.left[i - 1] = band.left[i] + band.differences[i - 1].size;
    }
    return band;
}

double size_of_light(const served::Scene& scene, const engine::SignalState& lighting) {
    double size = 0;
    for (std::size_t column = 0; column < scene.columns().count(); ++column) {
        size += size_of(lighting.whole(column));
    }
    return size;
}

class BandFilling final : public PlanMaker {
  public:
    explicit BandFilling(std::uint32_t columns) : columns_(columns) {}

    void make(const served::Scene& scene,
              const engine::SignalState& lighting,
              engine::Plan& plan) override {
        std::vector<Band> bands;
        std::size_t differing = 0;
        double left = 0;
        for (std::uint32_t b = 0; b < scene.columns().band_count(); ++b) {
            bands.push_back(band_of(scene, lighting, b));
            differing += bands.back().differences.size();
            left += bands.back().error();
        }
        fill(bands, std::min<std::size_t>(columns_, differing), left,
             size_of_light(scene, lighting));
        write_plan(scene, bands, differing, plan);
    }

  private:
    static void fill(std::vector<Band>& bands, std::size_t columns, double left, double light) {
        // A black light leaves no relative error: its differences count by their own size.
        const double scale = light > 0 ? light : left;
        std::size_t chosen = 0;
        std::size_t b = 0;
        double tolerance = kFirstTolerance;
        while (chosen < columns && left > kNegligibleError * scale) {
            Band& band = bands[b];
            if (band.error() > tolerance * scale) {
                left -= band.differences[band.taken].size;
                band.taken += 1;
                chosen += 1;
            } else if (++b == bands.size()) {
                tolerance *= kToleranceFactor;
                b = 0;
            }
        }
    }

    static void write_plan(const served::Scene& scene,
                           const std::vector<Band>& bands,
                           std::size_t differing,
                           engine::Plan& plan) {
        plan.bands_to_reset = 0;
        plan.changes.clear();
        plan.bytes = 0;
        plan.differing_columns = static_cast<std::uint32_t>(differing);
        for (const Band& band : bands) {
            const auto first = static_cast<std::ptrdiff_t>(plan.changes.size());
            for (std::size_t i = 0; i < band.taken; ++i) {
                plan.changes.push_back(band.differences[i].change);
                plan.bytes += scene.columns().bytes(plan.changes.back().column);
            }
            std::sort(plan.changes.begin() + first, plan.changes.end(),
                      [](const engine::ColumnChange& a, const engine::ColumnChange& b) {
                          return a.column < b.column;
                      });
        }
    }

    std::uint32_t columns_;
};

}  // namespace

std::unique_ptr<PlanMaker> make_band_filling(std::uint32_t columns) {
    return std::make_unique<BandFilling>(columns);
}

}  // namespace relume::lab
