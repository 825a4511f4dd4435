#include "tests/lab/geometry/interpolation_error.h"

#include "precompute/bake/mesh/surface_caster.h"
#include "precompute/bake/rays/ray_caster.h"
#include "protocol/transport/hash.h"
#include "tests/lab/geometry/point_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

using Imath::V2f;
using Imath::V3d;
using Imath::V3f;

// A texture has its colour in itself: about a half.
std::vector<V3f> mean_colours(const transport::MaterialRecord& material) {
    std::vector<V3f> colours;
    for (const transport::LobeRecord& lobe : material.lobes) {
        colours.push_back(lobe.texture ? V3f(0.5F) : lobe.colour);
    }
    return colours;
}

// Where a corner lies in the scene's triangle that it is a part of, a little towards a place
// inside: in the corner itself its rays might start in a wall.
V2f beside_corner(const scene::Scene& scene, const bake::Hit& inside, const V3f& corner) {
    constexpr float kInset = 0.04F;
    const scene::Mesh& mesh = scene.meshes[inside.mesh];
    const scene::Triangle& whole = mesh.triangles[inside.triangle];
    const V3d first(mesh.positions[whole[0]]);
    const V3d a = V3d(mesh.positions[whole[1]]) - first;
    const V3d b = V3d(mesh.positions[whole[2]]) - first;
    const V3d at = V3d(corner) - first;
    const V3d across = a.cross(b);
    const V2f found(static_cast<float>(at.cross(b).dot(across) / across.length2()),
                    static_cast<float>(a.cross(at).dot(across) / across.length2()));
    return found * (1 - kInset) + inside.barycentric * kInset;
}

}  // namespace

InterpolationError interpolation_error(const scene::Scene& scene,
                                       const transport::Transport& transport,
                                       const bake::BakeParameters& parameters,
                                       const bake::CubemapLight& light,
                                       std::size_t points) {
    const transport::Manifest& manifest = transport.manifest();
    const transport::Surface& surface = transport.surface().value();
    const transport::TileGrid& size = manifest.mesh->view;
    const std::vector<double> values = bake::relit_receivers(transport, light);
    const bake::RayCaster to_scene(scene);
    const bake::SurfaceCaster to_surface(surface, manifest.mesh->materials);
    // Two independent sets of rows, so that their noise is none of the error: the product of
    // two differences has the square of what they share for its mean.
    bake::BakeParameters again = parameters;
    again.seed = transport::mix_bits(parameters.seed + 1);
    const PointRows rows(to_scene, parameters, {&light, 1});
    const PointRows other_rows(to_scene, again, {&light, 1});
    struct Sums {
        double difference = 0;
        double of_exact_corners = 0;
        double norm = 0;
        std::size_t count = 0;
    };
    std::vector<Sums> sums(points);
    tbb::parallel_for(std::size_t{0}, points, [&](std::size_t i) {
        const std::uint64_t pixel =
            transport::mix_bits(i) % (std::uint64_t{size.width} * size.height);
        const V3f direction = manifest.camera.direction_from_pixel(
            static_cast<float>(pixel % size.width) + 0.5F,
            static_cast<float>(pixel / size.width) + 0.5F, size);
        const auto point = to_scene.closest_hit(manifest.camera.eye, direction);
        const auto hit = to_surface.closest_hit(manifest.camera.eye, direction);
        if (!point || !hit) {
            return;
        }
        const transport::SurfaceTriangle& triangle = surface.mesh.triangles[hit->triangle];
        const transport::MaterialRecord& material = manifest.mesh->materials[triangle.material];
        const brdf::FactoredBrdf& brdf = surface.brdfs[material.brdf];
        const std::array<float, 3> weights{1 - hit->barycentric.x - hit->barycentric.y,
                                           hit->barycentric.x, hit->barycentric.y};
        V3f normal(0);
        std::vector<V3d> interpolated(brdf.terms, V3d(0));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangle.vertices[corner];
            normal += weights[corner] * surface.mesh.normals[vertex];
            const transport::VertexPlace place =
                manifest.layout.clusters().place_of_vertex(vertex);
            for (std::uint32_t k = 0; k < brdf.terms; ++k) {
                for (int c = 0; c < 3; ++c) {
                    interpolated[k][c] +=
                        double{weights[corner]} * values[(std::size_t{place.block + k} * 3 +
                                                          static_cast<std::size_t>(c)) *
                                                             transport::kBlockSize +
                                                         place.slot];
                }
            }
        }
        normal.normalize();
        scene::SurfacePoint at = scene::surface_point(scene, point->mesh, point->triangle,
                                                      point->barycentric, direction);
        at.shading.normal = normal;
        const float edge = (surface.mesh.positions[triangle.vertices[0]] -
                            surface.mesh.positions[triangle.vertices[1]])
                               .length();
        const std::vector<V3f> colours = mean_colours(material);
        const auto seen = [&](const std::vector<V3d>& terms) {
            return towards_viewer(brdf, colours, normal, -direction, terms);
        };
        const auto number = static_cast<std::uint32_t>(i);
        const auto from_exact_corners = [&](const PointRows& of) {
            std::vector<V3d> terms(brdf.terms, V3d(0));
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = triangle.vertices[corner];
                scene::SurfacePoint beside = scene::surface_point(
                    scene, point->mesh, point->triangle,
                    beside_corner(scene, *point, surface.mesh.positions[vertex]), direction);
                beside.shading.normal = surface.mesh.normals[vertex];
                const auto own = of.terms(beside, brdf, edge, number).front();
                for (std::uint32_t k = 0; k < brdf.terms; ++k) {
                    terms[k] += double{weights[corner]} * own[k];
                }
            }
            return seen(terms);
        };
        const V3d truth = seen(rows.terms(at, brdf, edge, number).front());
        const V3d other = seen(other_rows.terms(at, brdf, edge, number).front());
        const V3d shown = seen(interpolated);
        sums[i] = {
            .difference = (shown - truth).dot(shown - other),
            .of_exact_corners =
                (from_exact_corners(rows) - truth).dot(from_exact_corners(other_rows) - other),
            .norm = truth.dot(other),
            .count = 1};
    });
    Sums total;
    for (const Sums& one : sums) {
        total.difference += one.difference;
        total.of_exact_corners += one.of_exact_corners;
        total.norm += one.norm;
        total.count += one.count;
    }
    return {.relative_l2 = std::sqrt(std::max(0.0, total.difference / total.norm)),
            .of_exact_corners = std::sqrt(std::max(0.0, total.of_exact_corners / total.norm)),
            .points = total.count};
}

}  // namespace relume::lab
