#include "tests/lab/geometry/interpolation_error.h"

#include "precompute/bake/mesh/surface_caster.h"
#include "precompute/bake/rays/ray_caster.h"
#include "protocol/transport/hash.h"
#include "tests/lab/geometry/point_rows.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

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
    const bake::SurfaceCaster to_surface(surface.mesh);
    // Two independent sets of rows, so that their noise is none of the error: the product of
    // two differences has the square of what they share for its mean.
    bake::BakeParameters again = parameters;
    again.seed = transport::mix_bits(parameters.seed + 1);
    const PointRows rows(to_scene, parameters, {&light, 1});
    const PointRows other_rows(to_scene, again, {&light, 1});
    struct Sums {
        double difference = 0;
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
        const V3d truth = seen(rows.terms(at, brdf, edge, number).front());
        const V3d other = seen(other_rows.terms(at, brdf, edge, number).front());
        const V3d shown = seen(interpolated);
        sums[i] = {.difference = (shown - truth).dot(shown - other),
                   .norm = truth.dot(other),
                   .count = 1};
    });
    Sums total;
    for (const Sums& one : sums) {
        total.difference += one.difference;
        total.norm += one.norm;
        total.count += one.count;
    }
    return {.relative_l2 = std::sqrt(total.difference / total.norm), .points = total.count};
}

}  // namespace relume::lab
