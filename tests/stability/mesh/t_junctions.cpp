// A refined room far from the origin, where the middle of an edge is rounded off the edge: a
// vertex that lies within another triangle's edge leaves a slit.
#include "precompute/bake/receivers/vertex/refinement.h"
#include "server/view/mesh/visible_surface.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/support/surface_shapes.h"
#include "tests/unit/surface/small_scenes.h"

#include <Imath/ImathQuat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace relume::stability {
namespace {

using transport::SurfaceMesh;

constexpr std::uint32_t kSide = 192;
constexpr float kFar = 1000;

// A room of side 2, turned, and so far away that single precision has steps of 0.06 mm there.
scene::Scene far_room() {
    const SurfaceMesh room = test::room(3);
    Imath::Quatf turn;
    turn.setAxisAngle(Imath::V3f(1, 2, 3).normalized(), 0.7F);
    scene::Mesh mesh;
    mesh.name = "room";
    for (const Imath::V3f& position : room.positions) {
        mesh.positions.push_back(turn.rotateVector(position) + Imath::V3f(kFar, -kFar, kFar));
    }
    for (const transport::SurfaceTriangle& triangle : room.triangles) {
        mesh.triangles.push_back(triangle.vertices);
    }
    scene::Scene scene = bake::scene_of({mesh});
    scene.camera.eye = {kFar, -kFar, kFar};
    return scene;
}

// Every third triangle is cut at its longest edge, and none beside it is.
SurfaceMesh cut_alone(SurfaceMesh mesh) {
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; i += 3) {
        const auto vertices = mesh.triangles[i].vertices;
        const auto length2 = [&](std::size_t k) {
            return (mesh.positions[vertices[(k + 1) % 3]] - mesh.positions[vertices[k]])
                .length2();
        };
        std::size_t longest = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            longest = length2(k) > length2(longest) ? k : longest;
        }
        const std::uint32_t a = vertices[longest];
        const std::uint32_t b = vertices[(longest + 1) % 3];
        const std::uint32_t c = vertices[(longest + 2) % 3];
        const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5F);
        mesh.normals.push_back(mesh.normals[a]);
        mesh.triangles[i].vertices = {a, middle, c};
        transport::SurfaceTriangle second = mesh.triangles[i];
        second.vertices = {middle, b, c};
        mesh.triangles.push_back(second);
    }
    return mesh;
}

struct Seen {
    double holes = 0;  // pixels in which nothing shows
    RelitImage picture;
};

// From places within the room, in all directions.
Seen look_around(const SurfaceMesh& mesh, std::size_t views) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-0.5, 0.5);
    Seen seen;
    double most = -1;
    view::VisibleSurface visible;
    for (std::size_t i = 0; i < views; ++i) {
        view::Pinhole pinhole;
        pinhole.eye = Imath::V3d(kFar, -kFar, kFar) +
                      Imath::V3d(place(random), place(random), place(random));
        pinhole.forward = Imath::V3d(place(random), place(random), place(random)).normalized();
        pinhole.right = pinhole.forward.cross({0, 1, 0}).normalized();
        pinhole.up = pinhole.right.cross(pinhole.forward);
        visible.look(mesh, pinhole, kSide, kSide);
        RelitImage picture{kSide, kSide, {}};
        double holes = 0;
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                const std::uint32_t triangle = visible.point(x, y).triangle;
                const bool is_hole = triangle == view::kNoTriangle;
                holes += is_hole ? 1 : 0;
                const float grey = is_hole ? 0 : 0.2F + 0.1F * static_cast<float>(triangle % 5);
                picture.rgb.insert(picture.rgb.end(), {is_hole ? 1.0F : grey, grey, grey});
            }
        }
        seen.holes += holes;
        if (holes > most) {
            most = holes;
            seen.picture = std::move(picture);
        }
    }
    return seen;
}

Outcome provoke(Workbench& workbench) {
    const scene::Scene scene = far_room();
    const bake::FormulaProbe stripes([](const bake::ProbePoint& point) {
        return std::sin(9 * point.position.x) > 0 ? 1.0F : 2.0F;
    });
    const SurfaceMesh refined =
        bake::refine_surface(scene, stripes, {.most_vertices = 3000, .target_error = 0}).mesh;
    const std::size_t views = workbench.choose<std::size_t>(24, 400);
    const Seen torn = look_around(cut_alone(refined), views);
    workbench.progress("t_junctions", 0.5);
    const Seen whole = look_around(refined, views);
    Outcome outcome;
    outcome.findings = {
        {"triangles cut alone: pixels that show nothing in a closed room", Sense::at_least, 1,
         torn.holes, "a rounded middle lies beside the edge that it was made on"},
        {"as refined: the same", Sense::at_most, 0, whole.holes,
         "all triangles at an edge are cut together, and their edge functions differ in sign "
         "alone"},
    };
    outcome.tiles = {{torn.picture, "triangles cut alone; holes are red"},
                     {whole.picture, "as refined"}};
    return outcome;
}

}  // namespace

Failure t_junctions() {
    return {.name = "t_junctions",
            .what = "slits open where a vertex lies within an edge",
            .scene =
                "the inside of a turned room of 3000 vertices, a kilometre from the "
                "origin, 192x192",
            .provoke = provoke};
}

}  // namespace relume::stability
