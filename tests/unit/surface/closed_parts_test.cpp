// Solid things are seen from outside, and nothing else loses a side.
#include "precompute/bake/receivers/vertex/closed_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relume::bake {
namespace {

using PointTriangle = std::array<std::uint32_t, 3>;

constexpr Imath::V3f kFarEye{0, 0, 50};

struct Shape {
    std::vector<Imath::V3f> points;
    std::vector<PointTriangle> triangles;

    [[nodiscard]] std::vector<SeenSides> sides(const Imath::V3f& eye = kFarEye) const {
        return seen_sides({points, triangles}, eye);
    }
};

// A tetrahedron with its front outside, after `first` other points.
std::vector<PointTriangle> tetrahedron(const PointTriangle& base, std::uint32_t apex) {
    const auto [a, b, c] = base;
    return {{a, c, b}, {a, b, apex}, {b, c, apex}, {c, a, apex}};
}

Shape solid() {
    return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            .triangles = tetrahedron({0, 1, 2}, 3)};
}

void turn(std::vector<PointTriangle>& triangles) {
    for (PointTriangle& triangle : triangles) {
        std::swap(triangle[1], triangle[2]);
    }
}

TEST(SeenSides, OfASolidAreOutside) {
    Shape shape = solid();
    EXPECT_EQ(shape.sides(), std::vector(4, SeenSides::front));
    turn(shape.triangles);
    EXPECT_EQ(shape.sides(), std::vector(4, SeenSides::back));
}

TEST(SeenSides, OfARoomAroundTheViewerAreBoth) {
    const Shape shape = solid();
    EXPECT_EQ(shape.sides({0.2F, 0.2F, 0.2F}), std::vector(4, SeenSides::both));
    // In its bounds, but not within.
    EXPECT_EQ(shape.sides({0.9F, 0.9F, 0.9F}), std::vector(4, SeenSides::front));
}

TEST(SeenSides, OfAnOpenShapeAreBoth) {
    Shape shape = solid();
    shape.triangles.pop_back();
    EXPECT_EQ(shape.sides(), std::vector(3, SeenSides::both));
}

TEST(SeenSides, OfAShapeWithOneTriangleTurnedAreBoth) {
    Shape shape = solid();
    std::swap(shape.triangles[2][0], shape.triangles[2][1]);
    EXPECT_EQ(shape.sides(), std::vector(4, SeenSides::both));
}

// Two solids that touch along the edge 0–1, one of them turned inside out.
TEST(SeenSides, OfSolidsThatShareAnEdgeAreTheirOwn) {
    Shape shape = solid();
    shape.points.push_back({0, -1, 0});
    shape.points.push_back({0, 0, -1});
    auto second = tetrahedron({0, 1, 4}, 5);
    turn(second);
    shape.triangles.insert(shape.triangles.end(), second.begin(), second.end());
    auto expected = std::vector(4, SeenSides::front);
    expected.resize(8, shape.sides()[4]);
    EXPECT_NE(expected[4], SeenSides::both);
    EXPECT_EQ(shape.sides(), expected);
}

// Two solids that touch with a whole side, whose edges then have four triangles each.
TEST(SeenSides, OfSolidsThatShareASideAreOutside) {
    Shape shape = solid();
    shape.points.push_back({0, 0, -1});
    const auto second = tetrahedron({0, 2, 1}, 4);
    shape.triangles.insert(shape.triangles.end(), second.begin(), second.end());
    EXPECT_EQ(shape.sides(), std::vector(8, SeenSides::front));
}

TEST(SeenSides, OfAFinOnASolidAreBoth) {
    Shape shape = solid();
    shape.points.push_back({0.5F, -1, -1});
    shape.triangles.push_back({0, 1, 4});
    auto expected = std::vector(4, SeenSides::front);
    expected.push_back(SeenSides::both);
    EXPECT_EQ(shape.sides(), expected);
    std::reverse(shape.triangles.begin(), shape.triangles.end());
    std::reverse(expected.begin(), expected.end());
    EXPECT_EQ(shape.sides(), expected);
}

// Two triangles back to back: every edge is balanced, and nothing lies between.
TEST(SeenSides, OfASheetThatIsFoldedOntoItselfAreBoth) {
    const Shape shape{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                      .triangles = {{0, 1, 2}, {0, 2, 1}}};
    EXPECT_EQ(shape.sides(), std::vector(2, SeenSides::both));
}

}  // namespace
}  // namespace relume::bake
