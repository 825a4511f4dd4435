#include "tests/lab/geometry/interpolation_error.h"

#include "precompute/bake/mesh/surface_caster.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/scene/camera.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/transport/hash.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

using Imath::V3d;
using Imath::V3f;

// Rows of points, and what they make of one light.
class PointRows {
  public:
    PointRows(const bake::RayCaster& caster,
              const bake::BakeParameters& parameters,
              const bake::CubemapLight& light)
        : texels_(parameters.face_resolution, parameters.seed),
          tracer_(caster, parameters),
          rows_(caster, texels_, parameters) {
        for (std::size_t c = 0; c < 3; ++c) {
            coefficients_[c].resize(rows_.projection().basis().coefficient_count());
            rows_.projection().project_radiance(light[c], coefficients_[c]);
        }
    }

    [[nodiscard]] std::vector<V3d> terms(const scene::SurfacePoint& point,
                                         const brdf::FactoredBrdf& brdf,
                                         float footprint,
                                         std::uint32_t number) const {
        bake::ReceiverSurface surface;
        surface.point = point;
        const brdf::Frame frame = brdf::local_frame(point.shading.normal);
        surface.point.shading = {
            .tangent = frame.tangent, .bitangent = frame.bitangent, .normal = frame.normal};
        surface.point.geometric_normal = frame.normal;
        surface.point.wo = {0, 0, 1};
        surface.point.bsdf = scene::Bsdf::lambert({1, 1, 1});
        surface.share = 1;
        surface.footprint = footprint;
        surface.origins.fill(bake::offset_origin(point));
        surface.brdf = &brdf;
        Scratch& scratch = scratches_.local();
        rows_.bake(tracer_.trace({.index = number,
                                  .place = {.run = number,
                                            .along = 0.7548776662466927 * number,
                                            .across = 0.5698402909980532 * number},
                                  .surfaces = {std::move(surface)}}),
                   nullptr, scratch.rows, scratch.baking);
        std::vector<V3d> lit(scratch.rows.size(), V3d(0));
        for (std::size_t k = 0; k < lit.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                for (std::size_t j = 0; j < coefficients_[c].size(); ++j) {
                    lit[k][static_cast<int>(c)] +=
                        double{scratch.rows[k].rgb[c][j]} * coefficients_[c][j];
                }
            }
        }
        return lit;
    }

  private:
    struct Scratch {
        bake::RowBaker::Scratch baking;
        std::vector<bake::CoefficientRow> rows;
    };

    bake::LightTexels texels_;
    bake::PathTracer tracer_;
    bake::RowBaker rows_;
    std::array<std::vector<float>, 3> coefficients_;
    mutable tbb::enumerable_thread_specific<Scratch> scratches_;
};

V3d towards_viewer(const transport::MaterialRecord& material,
                   const brdf::FactoredBrdf& brdf,
                   const V3f& normal,
                   const V3f& to_viewer,
                   const std::vector<V3d>& terms) {
    V3f local = brdf::local_frame(normal).local_from_world(to_viewer);
    local.z = std::max(local.z, brdf::kLeastViewCosine);
    std::vector<float> h(std::size_t{brdf.terms} * brdf.lobes);
    brdf.h.evaluate(local, h);
    V3d radiance(0);
    for (std::uint32_t lobe = 0; lobe < brdf.lobes; ++lobe) {
        // A texture has its colour in itself: about a half.
        const V3d colour =
            material.lobes[lobe].texture ? V3d(0.5) : V3d(material.lobes[lobe].colour);
        for (std::uint32_t k = 0; k < brdf.terms; ++k) {
            radiance += colour * double{h[k * brdf.lobes + lobe]} * terms[k];
        }
    }
    return radiance;
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
    const PointRows rows(to_scene, parameters, light);
    const PointRows other_rows(to_scene, again, light);
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
        const auto seen = [&](const std::vector<V3d>& terms) {
            return towards_viewer(material, brdf, normal, -direction, terms);
        };
        const auto number = static_cast<std::uint32_t>(i);
        const V3d truth = seen(rows.terms(at, brdf, edge, number));
        const V3d other = seen(other_rows.terms(at, brdf, edge, number));
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
