#include "protocol/light/light_rig.h"

#include "protocol/basis/cubemap_projection.h"
#include "protocol/light/background.h"
#include "protocol/light/rotation_resample.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::light {
namespace {

using namespace testing;

std::shared_ptr<const PrefilteredEnvironment> uniform(float value, std::uint32_t n) {
    return std::make_shared<PrefilteredEnvironment>(
        lat_long_map(8, [&](const Imath::V3f&) { return Imath::V3f(value); }), n);
}

TEST(LightRig, AnEmptyRigIsBlack) {
    LightCubemap cubemap(4);
    cubemap.radiance.assign(cubemap.radiance.size(), 9.0F);
    evaluate({}, 8, cubemap);
    EXPECT_EQ(cubemap.face_resolution, 8U);
    EXPECT_EQ(total_energy(cubemap), Imath::V3d(0));
    EXPECT_EQ(background_radiance({}, {0, 0, 1}, 1e-5F), Imath::V3f(0));
}

TEST(LightRig, BlendsAndScales) {
    LightRig rig;
    rig.environment = uniform(2, 8);
    rig.environment_scale = {1, 10, 0};
    LightCubemap cubemap;
    const auto expect = [&](float value) {
        evaluate(rig, 8, cubemap);
        EXPECT_NEAR(cubemap.planes()[0][17], value, 1e-5F);
        EXPECT_NEAR(cubemap.planes()[1][100], 10 * value, 1e-4F);
        EXPECT_EQ(cubemap.planes()[2][3], 0.0F);
        EXPECT_NEAR(background_radiance(rig, {0.1F, -1, 0.3F}, 1e-5F).x, value, 1e-5F);
    };
    expect(2);
    rig.blend_amount = 0.25F;
    expect(2);  // nothing to blend into
    rig.blend = uniform(6, 8);
    expect(3);
    rig.blend_amount = 1;
    expect(6);
    rig.environment = nullptr;
    rig.blend_amount = 0.5F;
    expect(3);
}

TEST(LightRig, RotationTurnsTheEnvironmentAndNotTheLights) {
    LightRig rig;
    rig.environment =
        std::make_shared<PrefilteredEnvironment>(lat_long_map(64, smooth_radiance), 8);
    rig.lights.push_back({{0, 1, 0}, 0.2F, {4, 4, 4}});
    std::mt19937 generator(1);
    rig.rotation = random_rotation(generator);
    LightCubemap cubemap;
    evaluate(rig, 8, cubemap);
    LightCubemap expected(8);
    resample(*rig.environment, rig.rotation, Imath::V3f(1), Write::overwrite, expected);
    add_area_light(rig.lights.front(), expected);
    EXPECT_EQ(cubemap.radiance, expected.radiance);
}

TEST(LightRig, RefusesAnEnvironmentForAnotherResolution) {
    LightRig rig;
    rig.environment = uniform(1, 8);
    LightCubemap cubemap;
    EXPECT_THROW(evaluate(rig, 16, cubemap), std::invalid_argument);
    EXPECT_THROW(evaluate(rig, 7, cubemap), std::invalid_argument);
}

TEST(LightRig, CoefficientsAreTheProjectionOfEveryPlane) {
    LightRig rig;
    rig.environment =
        std::make_shared<PrefilteredEnvironment>(lat_long_map(32, smooth_radiance), 8);
    LightCubemap cubemap;
    evaluate(rig, 8, cubemap);
    for (const basis::CubemapBasis& basis :
         {basis::CubemapBasis::haar(8), basis::CubemapBasis::spherical_harmonics(5, 8)}) {
        const auto projection = basis::CubemapProjection::onto(basis);
        const std::size_t count = basis.coefficient_count();
        std::vector<float> coefficients;
        lighting_coefficients(cubemap, *projection, coefficients);
        ASSERT_EQ(coefficients.size(), 3 * count);
        std::vector<float> expected(count);
        for (std::size_t colour = 0; colour < 3; ++colour) {
            projection->project_radiance(cubemap.planes()[colour], expected);
            for (std::size_t j = 0; j < count; ++j) {
                EXPECT_EQ(coefficients[colour * count + j], expected[j]);
            }
        }
    }
}

TEST(LightRig, RefusesAProjectionOfAnotherResolution) {
    const auto projection = basis::CubemapProjection::onto(basis::CubemapBasis::haar(16));
    std::vector<float> coefficients;
    EXPECT_THROW(lighting_coefficients(LightCubemap(8), *projection, coefficients),
                 std::invalid_argument);
}

}  // namespace
}  // namespace relume::light
