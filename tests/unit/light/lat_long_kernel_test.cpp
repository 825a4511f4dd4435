#include "protocol/light/lat_long_kernel.h"

#include "protocol/light/map_geometry.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace relume::light {
namespace {

using namespace testing;

// Everywhere, and where a quotient is 0/0, 1/0 or changes its sign.
std::vector<Imath::V3f> directions() {
    std::vector<Imath::V3f> all;
    for (const float x : {-1.0F, -0.0F, 0.0F, 1e-20F, 1.0F}) {
        for (const float y : {-1.0F, 0.0F, 1.0F}) {
            for (const float z : {-1.0F, -0.0F, 0.0F, 1.0F}) {
                if (x != 0 || y != 0 || z != 0) {
                    all.emplace_back(x, y, z);
                }
            }
        }
    }
    std::mt19937 random(4);
    for (int i = 0; i < 5000; ++i) {
        all.push_back(random_direction(random) * std::exp2(static_cast<float>(i % 9 - 4)));
    }
    return all;
}

TEST(LatLongPoints, AreThoseOfTheFormula) {
    const std::vector<Imath::V3f> all = directions();
    for (std::size_t first = 0; first < all.size(); first += kLooksPerRun) {
        // Runs of every length.
        const std::size_t count =
            std::min({kLooksPerRun, all.size() - first, first / kLooksPerRun + 1});
        LookDirections run;
        for (std::size_t i = 0; i < count; ++i) {
            run.set(i, all[first + i].x, all[first + i].y, all[first + i].z);
        }
        LatLongPoints points;
        lat_long_points(run, count, points);
        for (std::size_t i = 0; i < count; ++i) {
            const Imath::V3f& d = all[first + i];
            const MapPoint expected =
                map_point_from_direction(EnvironmentMap::Layout::lat_long, d);
            // Straight backwards is both ends of the map.
            const float apart = std::abs(points.x[i] - expected.x);
            EXPECT_LT(std::min(apart, 1 - apart), 4e-7F) << d;
            EXPECT_NEAR(points.y[i], expected.y, 4e-7F) << d;
            EXPECT_NEAR(points.cos_latitude[i], std::sqrt((d.x * d.x + d.z * d.z) / d.dot(d)),
                        1e-6F)
                << d;
        }
    }
}

TEST(FootprintLevels, AreTheLogarithmsOfTheSides) {
    for (std::size_t count = 1; count <= kLooksPerRun; ++count) {
        std::vector<float> footprints;
        for (std::size_t i = 0; i < count; ++i) {
            footprints.push_back(std::exp2(-static_cast<float>(i) / 3));
        }
        LookNumbers levels;
        footprint_levels(footprints, 0.25F, levels);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(levels[i], 2 - static_cast<float>(i) / 6, 1e-5F);
        }
    }
}

}  // namespace
}  // namespace relume::light
