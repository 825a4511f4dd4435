// The bits of a point against single rays, and their mean against what a horizon leaves.
#include "precompute/bake/fields/point_visibility.h"

#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/hash.h"
#include "protocol/transport/visibility_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace relume::bake {
namespace {

JitterShift random_shift(std::uint64_t seed) {
    JitterShift shift;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        const std::uint64_t bits = transport::mix_bits(seed * kPacketSize + lane);
        shift.column[lane] = transport::unit_float(bits);
        shift.row[lane] = transport::unit_float(bits << 32U);
    }
    return shift;
}

std::vector<std::uint64_t> bits_of(const RayCaster& caster,
                                   const LightTexels& texels,
                                   const LookingPoint& point,
                                   std::uint64_t& rays) {
    std::vector<std::uint64_t> bits(transport::words_of_visibility(texels.face_resolution()),
                                    ~std::uint64_t{0});
    PointVisibility::Scratch scratch;
    PointVisibility(caster, texels).compute(point, bits, scratch);
    rays += scratch.rays;
    return bits;
}

class PointVisibilityOfThinThings : public testing::Test {
  protected:
    // On the ground, in the middle of the scene's shadows.
    [[nodiscard]] LookingPoint point(std::uint64_t seed) const {
        const Imath::Box3f bounds = scene_.bounds();
        const Imath::V3f centre = bounds.center();
        LookingPoint point;
        point.shift = random_shift(seed);
        point.geometric_normal = Imath::V3f(0.2F, 1, -0.1F).normalized();
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            point.origins[lane] = {centre.x + 0.004F * static_cast<float>(lane),
                                   bounds.min.y + 0.02F * bounds.size().y, centre.z};
        }
        return point;
    }

    scene::Scene scene_ = scene::build_builtin_scene("thin");
    RayCaster caster_{scene_};
};

TEST_F(PointVisibilityOfThinThings, EqualsSingleRaysAboveTheSurface) {
    for (const std::uint32_t n : {4U, 16U}) {
        const LightTexels texels(n, 7);
        const LookingPoint at = point(n);
        std::uint64_t rays = 0;
        const auto bits = bits_of(caster_, texels, at, rays);
        const auto wrapped = [](float x) { return x >= 1 ? x - 1 : x; };
        std::size_t open = 0;
        std::size_t above = 0;
        for (std::size_t place = 0; place < texels.size(); ++place) {
            const std::size_t lane = place % kPacketSize;
            const bool is_open = transport::is_open(bits, texels.texel_index(place));
            open += is_open ? 1U : 0U;
            float highest = -1;
            for (const auto& [column, row] :
                 {std::pair{0, 0}, std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
                highest = std::max(highest, texels
                                                .cube_point(place, static_cast<float>(column),
                                                            static_cast<float>(row))
                                                .dot(at.geometric_normal));
            }
            if (highest <= 0) {
                EXPECT_FALSE(is_open) << place;
                continue;
            }
            const Imath::V3f direction = texels.cube_point(
                place, wrapped(texels.jitter_column()[place] + at.shift.column[lane]),
                wrapped(texels.jitter_row()[place] + at.shift.row[lane]));
            if (direction.dot(at.geometric_normal) > 0) {
                ++above;
                EXPECT_EQ(is_open, !caster_.is_occluded(at.origins[lane], direction)) << place;
            }
        }
        EXPECT_GT(open, texels.size() / 20);
        EXPECT_LT(open, texels.size() * 3 / 5);
        EXPECT_GE(rays, above);
        EXPECT_LE(rays, texels.size());
        // Bits beyond the last texel.
        EXPECT_EQ(n == 4 ? bits.back() >> 32U : 0, 0U);
    }
}

TEST_F(PointVisibilityOfThinThings, LooksAgainAtShadowEdgesAlone) {
    const LightTexels texels(16, 7);
    const PointVisibility visibility(caster_, texels);
    PointVisibility::Scratch scratch;
    std::vector<std::uint64_t> first(transport::words_of_visibility(16));
    std::vector<std::uint64_t> again(first.size());
    LookingPoint at = point(1);
    visibility.compute(at, first, scratch);
    const std::uint64_t rays = scratch.rays;
    at.shift = random_shift(2);
    at.looks_again = true;
    visibility.compute(at, again, scratch);
    EXPECT_LT(scratch.rays - rays, rays * 3 / 4);
    // The same ray as before at the same jitter, and another at another one.
    std::size_t changed = 0;
    std::size_t at_edge = 0;
    const auto open = [&](std::size_t face, std::size_t row, std::size_t column) {
        return transport::is_open(first, (face * 16 + row) * 16 + column);
    };
    for (std::size_t face = 0; face < 6; ++face) {
        for (std::size_t row = 2; row < 14; ++row) {
            for (std::size_t column = 2; column < 14; ++column) {
                bool any = false;
                bool all = true;
                for (std::size_t y = row - 2; y <= row + 2; ++y) {
                    for (std::size_t x = column - 2; x <= column + 2; ++x) {
                        any = any || open(face, y, x);
                        all = all && open(face, y, x);
                    }
                }
                const bool is_other =
                    open(face, row, column) !=
                    transport::is_open(again, (face * 16 + row) * 16 + column);
                changed += is_other ? 1U : 0U;
                at_edge += any && !all ? 1U : 0U;
                EXPECT_TRUE(!is_other || (any && !all)) << face << " " << row << " " << column;
            }
        }
    }
    EXPECT_GT(changed, 10U);
    EXPECT_GT(at_edge, changed);
}

// Where nothing is in the way a texel is open if any of it that a few tries find lies above.
TEST(PointVisibility, OfAnOpenPlaneIsTheHemisphereAbove) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    const RayCaster caster(scene);
    const LightTexels texels(16, 3);
    LookingPoint at;
    at.geometric_normal = {0, 1, 0};
    at.origins.fill({0, 1e-3F, 0});
    std::vector<double> mean(texels.size());
    constexpr int kPoints = 64;
    std::uint64_t rays = 0;
    for (std::uint64_t seed = 0; seed < kPoints; ++seed) {
        at.shift = random_shift(seed);
        const auto bits = bits_of(caster, texels, at, rays);
        for (std::size_t texel = 0; texel < mean.size(); ++texel) {
            mean[texel] += transport::is_open(bits, texel) ? 1.0 / kPoints : 0.0;
        }
    }
    EXPECT_EQ(rays, kPoints * texels.size() / 2);
    // ∫ cos over the open texels is π, whatever the rays are: faces of even n meet at the
    // horizon.
    double irradiance = 0;
    for (std::size_t place = 0; place < texels.size(); ++place) {
        const double open = mean[texels.texel_index(place)];
        EXPECT_EQ(open, texels.direction_y()[place] > 0 ? 1 : 0) << place;
        irradiance += open * double{texels.irradiance()[place] * texels.direction_y()[place]};
    }
    EXPECT_NEAR(irradiance, std::numbers::pi, 1e-4);
}

// At a horizon that cuts texels, each is open along its part above: nothing is lost twice.
TEST(PointVisibility, OfATiltedPlaneOpensWhatHasAPartAbove) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.camera.eye = {0, 3, 0};
    const RayCaster caster(scene);
    const LightTexels texels(8, 3);
    LookingPoint at;
    at.geometric_normal = Imath::V3f(0.3F, 0.9F, 0.2F).normalized();
    at.origins.fill({0, 50, 0});  // far above: the plane is a small patch below the horizon
    std::size_t cut = 0;
    std::uint64_t rays = 0;
    at.shift = random_shift(1);
    const auto bits = bits_of(caster, texels, at, rays);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        int above = 0;
        constexpr int kSide = 8;
        for (int i = 0; i < kSide * kSide; ++i) {
            const auto part = [](int of) {
                return (static_cast<float>(of) + 0.5F) / static_cast<float>(kSide);
            };
            above += texels.cube_point(place, part(i % kSide), part(i / kSide))
                                 .dot(at.geometric_normal) > 0
                         ? 1
                         : 0;
        }
        const bool is_open = transport::is_open(bits, texels.texel_index(place));
        if (above == 0) {
            continue;  // perhaps a corner
        }
        cut += above < kSide * kSide ? 1U : 0U;
        // Sixteen tries miss less than a tenth of a texel at times.
        if (above > kSide * kSide / 8) {
            EXPECT_TRUE(is_open) << place << " " << above;
        }
    }
    EXPECT_GT(cut, 20U);
}

}  // namespace
}  // namespace relume::bake
