#include "server/view/mesh/visible_surface.h"

#include "tests/support/surface_shapes.h"
#include "tests/unit/view/mesh/rays.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>
#include <vector>

namespace relume::view {
namespace {

using test::box;
using test::room;
using test::together;
using transport::SurfaceMesh;

TEST(VisibleSurface, IsWhatRaysMeetFirst) {
    const SurfaceMesh mesh = together(room(5), box(3, {0.2F, -0.3F, 0.1F}, 0.35F));
    constexpr std::uint32_t kSide = 50;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-0.9, 0.9);
    for (const double fov : {3.0, 40.0, 90.0, 150.0}) {
        for (int i = 0; i < 6; ++i) {
            const Imath::V3d eye(place(random), 0.1 + std::abs(place(random)), place(random));
            const Pinhole pinhole = pinhole_at(eye, {0.2, -0.3, 0.1}, fov);
            VisibleSurface surface;
            surface.look(mesh, pinhole, kSide, kSide);
            for (std::uint32_t y = 0; y < kSide; ++y) {
                for (std::uint32_t x = 0; x < kSide; ++x) {
                    const SurfacePoint& point = surface.point(x, y);
                    const Imath::V3d ray = ray_through(pinhole, x + 0.5, y + 0.5, kSide);
                    const Hit hit = nearest_front(mesh, eye, ray);
                    ASSERT_NE(point.triangle, kNoTriangle) << x << ", " << y;
                    if (hit.margin > 1e-6) {
                        ASSERT_EQ(point.triangle, hit.triangle) << x << ", " << y;
                    }
                    const Imath::V3d there = eye + ray * hit.depth;
                    EXPECT_LT((position_of(mesh, point) - there).length(), 2e-6)
                        << x << ", " << y << " at " << fov << " degrees";
                }
            }
        }
    }
}

// From inside a closed room nothing but the room shows, whichever way it is looked and however
// wide: also where the eye touches a wall, is a vertex, or edges pass through pixels' middles.
TEST(VisibleSurface, HasNoSeams) {
    const SurfaceMesh mesh = room(7);
    constexpr std::uint32_t kSide = 96;
    std::vector<Imath::V3d> eyes{{0, 0, 0}, {1e-9, 0, 0}, {0.5, 0.5, 0.5}, {-0.999999, 0, 0}};
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int i = 0; i < 6; ++i) {
        eyes.emplace_back(place(random), place(random), place(random));
    }
    const std::vector<Imath::V3d> directions{{1, 0, 0},   {0, -1, 0},       {0, 0, 1},
                                             {1, 1, 1},   {0.3, -0.2, -1},  {-1, 1e-9, 0},
                                             {-1, -1, 0}, {0.01, 0.7, -0.1}};
    for (const Imath::V3d& eye : eyes) {
        for (const Imath::V3d& direction : directions) {
            for (const double fov : {0.01, 60.0, 179.0}) {
                VisibleSurface surface;
                surface.look(mesh, pinhole_at(eye, eye + direction, fov), kSide, kSide);
                for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
                    const SurfacePoint& point = surface.point(i % kSide, i / kSide);
                    ASSERT_NE(point.triangle, kNoTriangle)
                        << eye << " towards " << direction << ", " << fov << " degrees, pixel "
                        << i % kSide << ", " << i / kSide;
                    ASSERT_GE(point.weight_1, 0);
                    ASSERT_GE(point.weight_2, 0);
                    ASSERT_LE(point.weight_1 + point.weight_2, 1.000001F);
                }
            }
        }
    }
}

// On a wall, at a vertex, behind a wall, far away: whatever shows, weights are finite.
TEST(VisibleSurface, IsFiniteFromWherever) {
    const SurfaceMesh mesh = together(room(4), box(2, {0, 0, 0}, 0.25F));
    for (const Imath::V3d& eye :
         {Imath::V3d(mesh.positions[3]), Imath::V3d(1, 0.1, 0.2), Imath::V3d(0, 0, 0),
          Imath::V3d(3, 2, 1), Imath::V3d(1e7, 0, 0), Imath::V3d(0.25, 0.25, 0.25)}) {
        for (const Imath::V3d& target : {Imath::V3d(0.1, 0.2, 0.3), Imath::V3d(9, 9, 9)}) {
            for (const double fov : {0.01, 90.0, 179.0}) {
                VisibleSurface surface;
                surface.look(mesh, pinhole_at(eye, target, fov), 40, 40);
                surface.look_at_edges(mesh);
                for (std::uint32_t i = 0; i < 1600; ++i) {
                    for (const SurfacePoint& point : surface.points(i % 40, i / 40)) {
                        ASSERT_TRUE(std::isfinite(point.weight_1)) << eye << ", " << fov;
                        ASSERT_TRUE(std::isfinite(point.weight_2)) << eye << ", " << fov;
                    }
                }
            }
        }
    }
}

// A box in front of nothing: pixels on its outline show it in some of their sixteen places, as
// many as the rays through these places meet; pixels beside it show one place.
TEST(VisibleSurface, LooksAtEdgesInSixteenPlaces) {
    const SurfaceMesh mesh = box(3, {0, 0, 0}, 0.5F);
    constexpr std::uint32_t kSide = 40;
    const Pinhole pinhole = pinhole_at({1.1, 1.7, 2.3}, {0, 0, 0}, 35);
    VisibleSurface surface;
    surface.look(mesh, pinhole, kSide, kSide);
    EXPECT_EQ(surface.edge_count(), 0U);
    surface.look_at_edges(mesh);
    std::size_t outline = 0;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            std::size_t expected = 0;
            for (std::size_t i = 0; i < 16; ++i) {
                const SamplePosition at = VisibleSurface::position_of_sample(i);
                const Imath::V3d ray = ray_through(pinhole, x + at.x, y + at.y, kSide);
                expected += nearest_front(mesh, pinhole.eye, ray).triangle != kNoTriangle
                                ? std::size_t{1}
                                : 0;
            }
            const auto points = surface.points(x, y);
            std::size_t hits = 0;
            for (const SurfacePoint& point : points) {
                hits += point.triangle != kNoTriangle ? 1 : 0;
            }
            if (points.size() == 1) {
                EXPECT_EQ(hits * 16, expected) << x << ", " << y;
            } else {
                EXPECT_EQ(hits, expected) << x << ", " << y;
                outline += hits > 0 && hits < 16 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(outline, 30U);
}

TEST(VisibleSurface, IsTheSameOnAnyNumberOfThreads) {
    const SurfaceMesh mesh = together(room(40), box(20, {0.2F, -0.3F, 0.1F}, 0.35F));
    const Pinhole pinhole = pinhole_at({-0.7, 0.5, 0.6}, {0.2, -0.3, 0.1}, 70);
    VisibleSurface alone;
    VisibleSurface shared;
    const auto look = [&](VisibleSurface& surface) {
        surface.look(mesh, pinhole, 130, 70);
        surface.look_at_edges(mesh);
    };
    tbb::task_arena(1).execute([&] { look(alone); });
    tbb::task_arena(4).execute([&] { look(shared); });
    ASSERT_EQ(alone.edge_count(), shared.edge_count());
    for (std::uint32_t i = 0; i < 130 * 70; ++i) {
        const auto a = alone.points(i % 130, i / 130);
        const auto b = shared.points(i % 130, i / 130);
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << i;
    }
}

}  // namespace
}  // namespace relume::view
