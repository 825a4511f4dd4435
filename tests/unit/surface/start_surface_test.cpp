// What a scene's surface is before any edge is split.
#include "precompute/bake/receivers/vertex/start_surface.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "tests/unit/surface/small_scenes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace relume::bake {
namespace {

constexpr std::size_t kMany = 100'000;

std::string refusal(const scene::Scene& scene, std::size_t most_vertices) {
    try {
        (void)start_surface(scene, most_vertices);
        return "";
    } catch (const BakeError& error) {
        return error.what();
    }
}

// Twelve triangles, whose corners meet in eight points, three normals at each.
TEST(StartSurface, ABoxKeepsItsCreases) {
    const StartSurface box = start_surface(scene_of({box_mesh({0, 0, 0}, {1, 2, 3})}), kMany);
    EXPECT_EQ(box.points.size(), 8U);
    EXPECT_EQ(box.vertices.size(), 24U);
    EXPECT_EQ(box.triangles.size(), 12U);
    EXPECT_EQ(box.two_sided_triangles, 0U);
    for (const StartTriangle& triangle : box.triangles) {
        for (const std::uint32_t vertex : triangle.vertices) {
            EXPECT_GT(box.vertices[vertex].normal.dot(triangle.face_normal), 0.999F);
        }
    }
}

TEST(StartSurface, ASmoothBallHasAVertexAtEachPoint) {
    const scene::Scene scene = scene_of({ball_mesh(24)});
    const StartSurface ball = start_surface(scene, kMany);
    EXPECT_EQ(ball.two_sided_triangles, 0U);
    // The pole's points coincide; their normals differ from sector to sector.
    const std::size_t poles = 2;
    EXPECT_EQ(ball.points.size(), 24U * 11 + poles);
    EXPECT_GE(ball.vertices.size(), ball.points.size());
    EXPECT_LE(ball.vertices.size(), ball.points.size() + 2 * 24);
}

TEST(StartSurface, FlatShadingMakesFacets) {
    scene::Scene scene = scene_of({ball_mesh(8)});
    scene.meshes[0].normals.clear();
    const StartSurface ball = start_surface(scene, kMany);
    for (const StartTriangle& triangle : ball.triangles) {
        for (const std::uint32_t vertex : triangle.vertices) {
            EXPECT_GT(ball.vertices[vertex].normal.dot(triangle.face_normal), 0.99998F);
        }
    }
}

TEST(StartSurface, MaterialsMeetInVerticesOfTheirOwn) {
    scene::Mesh left = square_mesh(2);
    scene::Mesh right = square_mesh(2);
    right.material = 1;
    for (Imath::V3f& position : right.positions) {
        position.x += 2;
    }
    EXPECT_EQ(start_surface(scene_of({left, right}, 2), kMany).vertices.size(), 2 * 8U);
    right.material = 0;  // meshes alone are no border
    EXPECT_EQ(start_surface(scene_of({left, right}, 2), kMany).vertices.size(), 2 * 6U);
    right.colours.assign(4, {1, 0, 0});  // colours are
    EXPECT_EQ(start_surface(scene_of({left, right}, 2), kMany).vertices.size(), 2 * 8U);
}

TEST(StartSurface, ASheetHasTwoSides) {
    const StartSurface sheet = start_surface(scene_of({square_mesh(2)}), kMany);
    EXPECT_EQ(sheet.points.size(), 4U);
    EXPECT_EQ(sheet.two_sided_triangles, 2U);
    ASSERT_EQ(sheet.triangles.size(), 4U);
    for (const StartTriangle& triangle : sheet.triangles) {
        const Imath::V3f up(0, triangle.is_behind ? -1.0F : 1.0F, 0);
        EXPECT_EQ(triangle.face_normal, up);
        const auto at = [&](std::size_t k) {
            return sheet.points[sheet.vertices[triangle.vertices[k]].point];
        };
        EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(up), 0);
        for (const std::uint32_t vertex : triangle.vertices) {
            EXPECT_EQ(sheet.vertices[vertex].normal, up);
        }
    }
}

TEST(StartSurface, HolesShowBothSides) {
    scene::Scene scene = scene_of({box_mesh({0, 0, 0}, {1, 1, 1})});
    scene.materials[0].alpha_cutoff = 0.5F;
    EXPECT_EQ(start_surface(scene, kMany).two_sided_triangles, 12U);
}

// Files wind a solid inside out and give it outward normals: neither is doubted.
TEST(StartSurface, ASolidThatIsWoundInsideOutIsSeenFromOutside) {
    scene::Scene scene = scene_of({box_mesh({0, 0, 0}, {1, 1, 1})});
    for (scene::Triangle& triangle : scene.meshes[0].triangles) {
        std::swap(triangle[1], triangle[2]);
    }
    const StartSurface box = start_surface(scene, kMany);
    EXPECT_EQ(box.two_sided_triangles, 0U);
    for (const StartTriangle& triangle : box.triangles) {
        EXPECT_TRUE(triangle.is_behind);
        const Imath::V3f& corner = box.points[box.vertices[triangle.vertices[0]].point];
        EXPECT_GT(triangle.face_normal.dot(corner), 0);
    }
}

TEST(StartSurface, TrianglesWithoutAreaAndDoublesAreDropped) {
    scene::Scene scene = scene_of({square_mesh(2)});
    scene::Mesh& mesh = scene.meshes[0];
    const scene::Triangle first = mesh.triangles[0];
    mesh.triangles.push_back({first[1], first[2], first[0]});  // the same
    mesh.triangles.push_back({first[1], first[0], first[2]});  // the other way round
    mesh.positions.push_back(mesh.positions[0]);               // on another corner
    mesh.positions.push_back((mesh.positions[0] + mesh.positions[1]) * 0.5F);
    mesh.normals.resize(6, {0, 1, 0});
    mesh.uvs.resize(6);
    mesh.triangles.push_back({0, 1, 4});
    mesh.triangles.push_back({0, 1, 5});
    const StartSurface surface = start_surface(scene, kMany);
    EXPECT_EQ(surface.dropped_triangles, 4U);
    EXPECT_EQ(surface.triangles.size(), 4U);  // two, of two sides
    mesh.triangles = {{0, 1, 4}};
    EXPECT_NE(refusal(scene, kMany).find("none of them has area"), std::string::npos);
}

// Three triangles at one edge, as a book has pages.
TEST(StartSurface, AnEdgeOfThreeTrianglesIsTaken) {
    scene::Scene scene = scene_of({book_mesh()});
    const StartSurface book = start_surface(scene, kMany);
    EXPECT_EQ(book.triangles.size(), 6U);
    EXPECT_EQ(book.two_sided_triangles, 3U);
}

TEST(StartSurface, NormalsThatAreNoneAreReplaced) {
    scene::Scene scene = scene_of({square_mesh(2)});
    scene.meshes[0].normals[1] = {0, 0, 0};
    scene.meshes[0].normals[2].x = std::numeric_limits<float>::quiet_NaN();
    for (const StartVertex& vertex : start_surface(scene, kMany).vertices) {
        EXPECT_EQ(std::abs(vertex.normal.y), 1.0F);
    }
}

TEST(StartSurface, TooFewVerticesAreRefusedWithBothNumbers) {
    const scene::Scene box = scene_of({box_mesh({0, 0, 0}, {1, 1, 1})});
    EXPECT_EQ(refusal(box, 24), "");
    const std::string refused = refusal(box, 23);  // more than there are points
    EXPECT_NE(refused.find("24 vertices"), std::string::npos) << refused;
    EXPECT_NE(refused.find("at most 23"), std::string::npos) << refused;
    const std::string by_points = refusal(box, 7);
    EXPECT_NE(by_points.find("at 8 places"), std::string::npos) << by_points;
    EXPECT_NE(by_points.find("at most 7"), std::string::npos) << by_points;
    EXPECT_NE(by_points.find("MB"), std::string::npos) << by_points;
}

// Ten million triangles, as a scan has them: refused before anything is made of them but a list
// of their points, and told what memory so large a surface would take.
TEST(StartSurface, TenMillionTrianglesAreRefusedWithTheirMemory) {
    constexpr std::uint32_t kSide = 2237;  // 2236² squares of two triangles
    scene::Scene scene = scene_of({{}});
    scene::Mesh& mesh = scene.meshes[0];
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        mesh.positions.emplace_back(static_cast<float>(i % kSide), 0,
                                    static_cast<float>(i / kSide));
    }
    for (std::uint32_t i = 0; i < kSide * (kSide - 1); ++i) {
        if (i % kSide != kSide - 1) {
            mesh.triangles.push_back({i, i + 1, i + kSide});
            mesh.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
        }
    }
    ASSERT_GE(mesh.triangles.size(), 9'990'000U);
    const std::string refused = refusal(scene, 250'000);
    EXPECT_NE(refused.find("vertices at 5004169 places"), std::string::npos) << refused;
    EXPECT_NE(refused.find("at most 250000"), std::string::npos) << refused;
    EXPECT_NE(refused.find("at about 15513 MB"), std::string::npos) << refused;
}

// As many over four points.
TEST(StartSurface, FarTooManyTrianglesAreRefused) {
    scene::Scene scene = scene_of({square_mesh(2)});
    scene.meshes[0].triangles.assign(10'000'000, {0, 1, 2});
    const std::string refused = refusal(scene, 250'000);
    EXPECT_NE(refused.find("10000000 triangles"), std::string::npos) << refused;
    EXPECT_NE(refused.find("at most 4000000"), std::string::npos) << refused;
}

}  // namespace
}  // namespace relume::bake
