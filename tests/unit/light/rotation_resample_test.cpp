#include "protocol/light/rotation_resample.h"

#include "protocol/basis/cubemap.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::light {
namespace {

using namespace testing;

constexpr float kPi = std::numbers::pi_v<float>;

LightCubemap rotated(const PrefilteredEnvironment& environment, const Imath::Quatf& rotation) {
    LightCubemap cubemap(environment.face_resolution());
    resample(environment, rotation, Imath::V3f(1), Write::overwrite, cubemap);
    return cubemap;
}

double relative_l2(const LightCubemap& a, const LightCubemap& b) {
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i) {
        difference += std::pow(double{a.radiance[i]} - double{b.radiance[i]}, 2);
        size += std::pow(double{b.radiance[i]}, 2);
    }
    return std::sqrt(difference / size);
}

Imath::Quatf about(const Imath::V3f& axis, float angle) {
    Imath::Quatf rotation;
    return rotation.setAxisAngle(axis, angle);
}

TEST(RotationResample, AConstantMapStaysConstantInEveryProjectionAndRotation) {
    struct {
        Projection projection;
        std::uint32_t width;
        std::uint32_t height;
    } const shapes[] = {{Projection::lat_long, 64, 32},
                        {Projection::vertical_cross, 48, 64},
                        {Projection::angular_map, 64, 64},
                        {Projection::cubemap_strip, 96, 16}};
    std::mt19937 generator(1);
    for (const auto& shape : shapes) {
        const auto map = std::make_shared<EnvironmentMap>(
            draw(
                shape.projection, shape.width, shape.height,
                [](const Imath::V3f&) { return Imath::V3f(3, 1, 0.1F); }, 2, 1e4F),
            shape.projection);
        for (const std::uint32_t n : {4U, 16U}) {
            const PrefilteredEnvironment environment(map, n);
            for (int i = 0; i < 5; ++i) {
                const LightCubemap cubemap = rotated(environment, random_rotation(generator));
                const auto planes = cubemap.planes();
                for (const float value : planes[0]) {
                    ASSERT_NEAR(value, 3.0F, 3e-6F) << to_string(shape.projection);
                }
                for (const float value : planes[2]) {
                    ASSERT_NEAR(value, 0.1F, 1e-7F) << to_string(shape.projection);
                }
            }
        }
    }
}

// The largest relative L2 distance of any projection's lighting from that of a lat-long map.
double distance_between_projections(const Radiance& radiance, std::uint32_t n) {
    const PrefilteredEnvironment reference(lat_long_map(256, radiance), n);
    struct {
        Projection projection;
        std::uint32_t width;
        std::uint32_t height;
    } const shapes[] = {
        {Projection::vertical_cross, 384, 512}, {Projection::horizontal_cross, 512, 384},
        {Projection::angular_map, 512, 512},    {Projection::cubemap_strip, 768, 128},
        {Projection::cubemap_strip, 128, 768},  {Projection::lat_long, 600, 201}};
    std::mt19937 generator(2);
    double largest = 0;
    for (const auto& shape : shapes) {
        const PrefilteredEnvironment environment(
            std::make_shared<EnvironmentMap>(
                draw(shape.projection, shape.width, shape.height, radiance), shape.projection),
            n);
        for (const Imath::Quatf& rotation : {Imath::Quatf(), random_rotation(generator)}) {
            largest = std::max(largest, relative_l2(rotated(environment, rotation),
                                                    rotated(reference, rotation)));
        }
    }
    return largest;
}

TEST(RotationResample, EveryProjectionOfOneEnvironmentGivesTheSameLighting) {
    EXPECT_LT(distance_between_projections(smooth_radiance, 16), 1e-4);
}

TEST(RotationResample, EveryProjectionShowsEdgesAtTheSamePlace) {
    // A bright window; its edges are askew to every projection's texels, which cannot hold
    // them.
    const Radiance window = [](const Imath::V3f& d) {
        const bool inside = d.dot({0.9F, 0.3F, -0.1F}) > 0.2F &&
                            d.dot({-0.4F, 0.9F, -0.3F}) > 0.0F &&
                            d.dot({0.2F, -0.5F, -0.8F}) > 0.1F;
        return smooth_radiance(d) + Imath::V3f(inside ? 20.0F : 0.0F);
    };
    EXPECT_LT(distance_between_projections(window, 16), 0.003);
}

TEST(RotationResample, ASunKeepsItsEnergyWhereverItStands) {
    std::mt19937 generator(3);
    for (const std::uint32_t n : {8U, 32U}) {
        for (int sun = 0; sun < 6; ++sun) {
            constexpr std::uint32_t kHeight = 256;
            const auto map = one_texel_map(
                kHeight, std::uniform_int_distribution<std::uint32_t>(0, 511)(generator),
                std::uniform_int_distribution<std::uint32_t>(8, 247)(generator), 1e5F);
            const PrefilteredEnvironment environment(map, n);
            const double energy = map->total_energy().x;
            for (int i = 0; i < 60; ++i) {
                const LightCubemap cubemap = rotated(environment, random_rotation(generator));
                EXPECT_NEAR(total_energy(cubemap).x / energy, 1.0, 0.02) << "n = " << n;
            }
        }
    }
}

TEST(RotationResample, ASunStaysWhereItIs) {
    // Energy must not only be kept but lie within about a texel of the sun.
    constexpr std::uint32_t kN = 32;
    const auto map = one_texel_map(256, 100, 90, 1e5F);
    const auto direction =
        direction_at(Projection::lat_long, 512, 256, 100.5 / 512, 90.5 / 256);
    const PrefilteredEnvironment environment(map, kN);
    std::mt19937 generator(4);
    for (int i = 0; i < 40; ++i) {
        const Imath::Quatf rotation = random_rotation(generator);
        const LightCubemap cubemap = rotated(environment, rotation);
        const Imath::V3f expected = rotation.rotateVector(*direction);
        Imath::V3d centroid(0);
        double energy = 0;
        double near = 0;
        for (std::size_t texel = 0; texel < cubemap.plane_size(); ++texel) {
            const basis::Texel place = basis::texel_from_index(kN, texel);
            const Imath::V3f d = basis::direction_from_texel(kN, place);
            const double part =
                cubemap.radiance[texel] * basis::solid_angle_sr(kN, place.row, place.column);
            centroid += part * Imath::V3d(d);
            energy += part;
            near += (d - expected).length() < 2.5F * 2 / kN ? part : 0;
        }
        EXPECT_LT((Imath::V3f(centroid.normalized()) - expected).length(), 0.3F * 2 / kN);
        EXPECT_GT(near / energy, 0.999);
    }
}

TEST(RotationResample, WorldDirectionIsRotationTimesSourceDirection) {
    const PrefilteredEnvironment environment(
        lat_long_map(
            64, [](const Imath::V3f& d) { return Imath::V3f(d.z < -0.9F ? 100.0F : 0.0F); }),
        16);
    // R_y(90°) takes −Z to −X; R_x(90°) takes −Z to +Y; R_z leaves it.
    struct {
        Imath::V3f axis;
        Imath::V3f expected;
    } const cases[] = {
        {{0, 1, 0}, {-1, 0, 0}}, {{1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, -1}}};
    for (const auto& c : cases) {
        const LightCubemap cubemap = rotated(environment, about(c.axis, kPi / 2));
        const auto texel = basis::texel_from_direction(16, c.expected + Imath::V3f(1e-3F));
        EXPECT_NEAR(cubemap.radiance[basis::index_from_texel(16, texel)], 100.0F, 0.1F)
            << c.axis;
    }
}

TEST(RotationResample, AFullTurnInStepsEqualsTheStart) {
    const PrefilteredEnvironment environment(lat_long_map(128, smooth_radiance), 32);
    const Imath::V3f axis = Imath::V3f(1, 2, -0.5F).normalized();
    const LightCubemap start = rotated(environment, Imath::Quatf());
    Imath::Quatf rotation;
    const Imath::Quatf step = about(axis, 2 * kPi / 360);
    LightCubemap last;
    for (int i = 0; i < 360; ++i) {
        rotation = (step * rotation).normalized();
        if (i == 180) {
            EXPECT_GT(relative_l2(rotated(environment, rotation), start), 0.1);
        }
    }
    EXPECT_LT(relative_l2(rotated(environment, rotation), start), 1e-5);
}

TEST(RotationResample, ScalesByColourAndAccumulates) {
    const PrefilteredEnvironment environment(lat_long_map(32, smooth_radiance), 8);
    const Imath::Quatf rotation = about({0, 1, 0}, 0.7F);
    const LightCubemap once = rotated(environment, rotation);
    LightCubemap twice(8);
    resample(environment, rotation, {1, 2, 0}, Write::overwrite, twice);
    resample(environment, rotation, {1, 0, 0.5F}, Write::accumulate, twice);
    for (std::size_t i = 0; i < once.plane_size(); ++i) {
        EXPECT_FLOAT_EQ(twice.planes()[0][i], 2 * once.planes()[0][i]);
        EXPECT_FLOAT_EQ(twice.planes()[1][i], 2 * once.planes()[1][i]);
        EXPECT_FLOAT_EQ(twice.planes()[2][i], 0.5F * once.planes()[2][i]);
    }
}

TEST(RotationResample, RefusesWhatDoesNotFit) {
    const auto map = lat_long_map(16, smooth_radiance, 1);
    EXPECT_THROW(PrefilteredEnvironment(map, 24), std::invalid_argument);
    const PrefilteredEnvironment environment(map, 8);
    LightCubemap other(16);
    EXPECT_THROW(resample(environment, {}, Imath::V3f(1), Write::overwrite, other),
                 std::invalid_argument);
    LightCubemap fitting(8);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Imath::Quatf& rotation :
         {Imath::Quatf(nan, 0, 0, 0), Imath::Quatf(0, 0, 0, 0)}) {
        EXPECT_THROW(resample(environment, rotation, Imath::V3f(1), Write::overwrite, fitting),
                     std::invalid_argument);
    }
}

}  // namespace
}  // namespace relume::light
