// The points that stand for a pixel's editable materials.
#include "precompute/bake/fields/pixel_points.h"

#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/scene/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace relume::bake {
namespace {

// All of the scene's materials are editable, each by its own number.
EditableIndices all_of(const scene::Scene& scene) {
    EditableIndices indices;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        indices.emplace_back(static_cast<std::uint8_t>(i));
    }
    return indices;
}

TEST(PixelPoints, SharesSumUpToTheCoverageOfTheirMaterials) {
    const scene::Scene scene = scene::build_builtin_scene("earrings");
    const RayCaster caster(scene);
    const PixelReceivers pixels(caster, {.width = 64, .height = 48, .pixel_samples = 4});
    EditableIndices indices = all_of(scene);
    indices[1].reset();
    std::size_t several = 0;
    std::size_t seen = 0;
    for (std::size_t pixel = 0; pixel < pixels.receiver_count(); ++pixel) {
        const Receiver receiver = pixels.look(pixel);
        std::map<std::uint32_t, float> of_surfaces;
        for (const ReceiverSurface& surface : receiver.surfaces) {
            if (surface.material != 1) {
                of_surfaces[surface.material] += surface.share;
            }
        }
        std::map<std::uint32_t, float> of_points;
        const auto points = points_of_pixel(receiver, indices, 5);
        EXPECT_LE(points.size(), kMostPointsOfPixel);
        for (const PixelPoint& point : points) {
            of_points[point.seen.material] += point.seen.share;
            EXPECT_GT(point.seen.share, 0);
            EXPECT_NEAR(point.seen.normal.length(), 1, 1e-4);
            EXPECT_NEAR(point.seen.wo.length(), 1, 1e-4);
            EXPECT_GT(point.seen.normal.dot(point.seen.wo), 0);
            EXPECT_GT(point.seen.geometric_normal.dot(point.seen.wo), 0);
            EXPECT_EQ(point.looking.geometric_normal, point.seen.geometric_normal);
        }
        ASSERT_EQ(of_points.size(), of_surfaces.size()) << pixel;
        for (const auto& [material, share] : of_surfaces) {
            EXPECT_NEAR(of_points.at(material), share, 1e-5) << pixel;
        }
        several += points.size() > of_surfaces.size() ? 1U : 0U;
        seen += points.empty() ? 0U : 1U;
    }
    EXPECT_GT(seen, pixels.receiver_count() / 4);
    EXPECT_GT(several, 10U);
}

TEST(PixelPoints, OneThatTurnsIsFourOfItsTurns) {
    Receiver receiver;
    ReceiverSurface surface;
    surface.share = 1;
    for (int i = 0; i < 16; ++i) {
        scene::SurfacePoint turn = surface.point;
        turn.position.x = static_cast<float>(i);
        surface.turns.push_back(turn);
    }
    receiver.surfaces = {surface};
    const EditableIndices indices{std::uint8_t{0}};
    const auto four = points_of_pixel(receiver, indices, 0);
    ASSERT_EQ(four.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(four[i].seen.share, 0.25F);
        EXPECT_NEAR(four[i].looking.origins[7].x, static_cast<float>(i), 1e-4);
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(four[i].looking.shift.column, four[j].looking.shift.column);
        }
    }
    EXPECT_FALSE(four[1].looking.looks_again);
    receiver.surfaces[0].share = 0.3F;
    EXPECT_EQ(points_of_pixel(receiver, indices, 0).size(), 2U);
    receiver.surfaces[0].share = 0.2F;
    EXPECT_EQ(points_of_pixel(receiver, indices, 0).size(), 1U);
}

TEST(PixelPoints, OneThatDoesNotTurnIsTwoAlikeOfWhichOneLooksAgain) {
    Receiver receiver;
    ReceiverSurface surface;
    surface.share = 0.9F;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        surface.origins[lane] = Imath::V3f(static_cast<float>(lane), 0, 0);
    }
    receiver.surfaces = {surface};
    const auto two = points_of_pixel(receiver, EditableIndices{std::uint8_t{0}}, 0);
    ASSERT_EQ(two.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(two[i].seen, two[0].seen);
        EXPECT_EQ(two[i].looking.origins, surface.origins);
        EXPECT_EQ(two[i].looking.looks_again, i > 0);
    }
    // Stratified: the two rays of a texel are not close to each other.
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        for (std::size_t i = 1; i < 2; ++i) {
            const float apart =
                std::abs(two[i].looking.shift.column[lane] - two[0].looking.shift.column[lane]);
            EXPECT_GT(std::min(apart, 1 - apart), 0.2F);
        }
    }
}

TEST(PixelPoints, ManySurfacesAreFewPointsOfTheSameShares) {
    Receiver receiver;
    EditableIndices indices;
    std::map<std::uint32_t, float> expected;
    for (std::uint32_t i = 0; i < 100; ++i) {
        ReceiverSurface surface;
        surface.number = i;
        surface.material = i % 7 == 0 ? i / 7 : 15;
        surface.share = static_cast<float>(1 + i % 5) / 400;
        expected[surface.material] += surface.share;
        receiver.surfaces.push_back(surface);
    }
    for (std::uint8_t i = 0; i < 16; ++i) {
        indices.emplace_back(i);
    }
    ASSERT_EQ(expected.size(), 16U);
    const auto points = points_of_pixel(receiver, indices, 0);
    EXPECT_EQ(points.size(), kMostPointsOfPixel);
    std::map<std::uint32_t, float> found;
    for (const PixelPoint& point : points) {
        found[point.seen.material] += point.seen.share;
    }
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [material, share] : expected) {
        EXPECT_NEAR(found.at(material), share, 1e-5) << material;
    }
}

}  // namespace
}  // namespace relume::bake
