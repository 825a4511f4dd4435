#include "precompute/bake/rows/spherical_polygon.h"

#include "precompute/bake/rows/light_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relume::bake {
namespace {

const Imath::V3d kNormal = Imath::V3d(0.3, 0.8, -0.52).normalized();

TEST(SphericalPolygon, OctantHasTheKnownVectorIrradiance) {
    SphericalPolygon polygon(
        {Imath::V3d(1, 0, 0), Imath::V3d(1, 1, 0), Imath::V3d(0, 1, 0), Imath::V3d(0, 0, 1)});
    // Each of the three faces of the octant has the form factor 1/4 of a hemisphere's π.
    const Imath::V3d vector = polygon.vector_irradiance();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(vector[axis], std::numbers::pi / 4, 1e-12);
    }
}

TEST(SphericalPolygon, ClippingKeepsTheHalfAboveAndTheHalfBelow) {
    const LightTexels texels(8, 0);
    for (std::size_t place = 0; place < texels.size(); ++place) {
        SphericalPolygon above = texels.polygon(place);
        SphericalPolygon below = above;
        const Imath::V3d whole = above.vector_irradiance();
        above.clip(kNormal);
        below.clip(-kNormal);
        const Imath::V3d parts = above.vector_irradiance() + below.vector_irradiance();
        EXPECT_LT((parts - whole).length(), 1e-12) << place;
        EXPECT_GE(above.vector_irradiance().dot(kNormal), -1e-15) << place;
    }
}

TEST(SphericalPolygon, TexelsOfAHemisphereAddUpToPi) {
    for (const std::uint32_t n : {4U, 16U, 64U}) {
        const LightTexels texels(n, 0);
        double sum = 0;
        for (std::size_t place = 0; place < texels.size(); ++place) {
            SphericalPolygon polygon = texels.polygon(place);
            polygon.clip(kNormal);
            sum += polygon.vector_irradiance().dot(kNormal);
        }
        EXPECT_NEAR(sum, std::numbers::pi, 1e-6) << n;
    }
}

TEST(SphericalPolygon, NothingIsLeftWhenAllIsClipped) {
    SphericalPolygon polygon({Imath::V3d(1, 0.1, 0), Imath::V3d(1, 0.2, 0),
                              Imath::V3d(1, 0.2, 0.1), Imath::V3d(1, 0.1, 0.1)});
    polygon.clip({0, -1, 0});
    EXPECT_TRUE(polygon.empty());
    EXPECT_EQ(polygon.vector_irradiance(), Imath::V3d(0, 0, 0));
}

}  // namespace
}  // namespace relume::bake
