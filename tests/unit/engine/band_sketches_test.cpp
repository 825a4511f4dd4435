#include "server/engine/choosing/band_sketches.h"

#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::engine {
namespace {

// Σ_j scale·value·L over the columns of one band, in the plainest way.
std::vector<double> plain_sketch(const served::Scene& scene,
                                 const transport::Sketch& sketch,
                                 std::span<const float> lighting,
                                 std::uint32_t band) {
    std::vector<double> sums(transport::kColours * std::size_t{sketch.rows()});
    for (std::size_t j = 0; j < scene.columns().count(); ++j) {
        for (std::uint32_t c = 0; scene.columns().bands()[j] == band && c < transport::kColours; ++c) {
            const double weight = double{lighting[c * scene.columns().count() + j]} *
                                  double{sketch.scale(j, c)};
            for (std::size_t r = 0; r < sketch.rows(); ++r) {
                sums[c * sketch.rows() + r] += weight * sketch.values(j, c)[r];
            }
        }
    }
    return sums;
}

std::vector<double> sum_of(const BandSketches& bands) {
    std::vector<double> sums;
    for (std::size_t r = 0; r < bands.size(); ++r) {
        sums.push_back(bands.sum(r));
    }
    return sums;
}

double norm(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) {
        sum += value * value;
    }
    return std::sqrt(sum);
}

void expect_near(std::span<const double> found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], 1e-6 * norm(expected));
    }
}

TEST(BandSketches, HoldEveryBandOfALighting) {
    const TinyScene tiny({.channels = 3});
    const served::Scene& scene = *tiny.scene();
    const auto lighting = test::random_lighting(8, 1);
    for (const transport::Sketch* sketch :
         {&tiny.transport().stating_sketch(), &tiny.transport().choosing_sketch()}) {
        BandSketches bands(scene.columns(), *sketch);
        SignificantColumns lit(scene.columns());
        lit.set(lighting);
        bands.set(lit);
        std::vector<double> total(transport::kColours * std::size_t{sketch->rows()});
        for (std::uint32_t b = 0; b < scene.columns().band_count(); ++b) {
            const auto expected = plain_sketch(scene, *sketch, lighting, b);
            expect_near(bands.band(b), expected);
            for (std::size_t i = 0; i < total.size(); ++i) {
                total[i] += expected[i];
            }
        }
        expect_near(sum_of(bands), total);
    }
}

// A sun over a faint sky, of which most columns do not count: what is left out leaves no more
// of the norm than is stated.
TEST(BandSketches, LeaveOutOnlyWhatDoesNotCount) {
    const TinyScene tiny({.channels = 3});
    const served::Scene& scene = *tiny.scene();
    auto lighting = test::random_lighting(8, 3);
    for (std::size_t i = 0; i < lighting.size(); ++i) {
        lighting[i] *= i % 50 == 0 ? 1.0F : 1e-7F;
    }
    BandSketches whole(scene.columns(), tiny.transport().stating_sketch());
    BandSketches nearly(scene.columns(), tiny.transport().stating_sketch());
    SignificantColumns lit(scene.columns());
    lit.set(lighting);
    whole.set(lit);
    lit.set_nearly(lighting, kSurelyNegligible);
    nearly.set(lit);
    const auto all = sum_of(whole);
    auto left_out = sum_of(nearly);
    for (std::size_t i = 0; i < all.size(); ++i) {
        left_out[i] -= all[i];
    }
    EXPECT_GT(norm(left_out), 0);
    EXPECT_LT(norm(left_out), 2e-6 * norm(all));
}

// However bright what came and went, updates in double precision leave nothing of it.
TEST(BandSketches, KeepNothingOfALightThatIsGone) {
    const TinyScene tiny;
    const served::Scene& scene = *tiny.scene();
    const transport::Sketch& sketch = tiny.transport().choosing_sketch();
    const auto lighting = test::random_lighting(8, 2);
    BandSketches bands(scene.columns(), sketch);
    SignificantColumns lit(scene.columns());
    lit.set(lighting);
    bands.set(lit);
    const auto before = sum_of(bands);
    Plan on;
    on.changes = {{.column = 7, .to = {1e5F, 2e5F, 3e5F}}};
    Plan off;
    off.changes = {{.column = 7, .from = {1e5F, 2e5F, 3e5F}}};
    for (int i = 0; i < 1000; ++i) {
        bands.apply(on);
        bands.apply(off);
    }
    const auto after = sum_of(bands);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_NEAR(after[i], before[i], 1e-7 * norm(before));
    }
}

}  // namespace
}  // namespace relume::engine
