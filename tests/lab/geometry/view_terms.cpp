#include "tests/lab/geometry/view_terms.h"

#include "precompute/bake/mesh/mesh_materials.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/factors/brdf_lobes.h"
#include "precompute/scene/camera.h"
#include "tests/lab/geometry/orbit.h"
#include "tests/lab/geometry/point_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::lab {
namespace {

using Imath::V3d;
using Imath::V3f;

constexpr double kFullTurn = 360;

bake::BakeParameters parameters_of(const ViewTermsOptions& options) {
    bake::BakeParameters parameters;
    parameters.receivers = bake::ReceiverKind::vertices;
    parameters.face_resolution = options.face_resolution;
    parameters.bounces = 0;
    return parameters;
}

scene::Camera camera_of_view(const scene::CameraPlacement& placement,
                             double degrees,
                             std::uint32_t side) {
    const view::Look look = orbited(
        {.eye = V3d(placement.eye), .look_at = V3d(placement.look_at), .up = V3d(placement.up)},
        degrees);
    scene::CameraPlacement turned = placement;
    turned.eye = V3f(look.eye);
    turned.up = V3f(look.up);
    return {turned, side, side};
}

// Of one image or several, by K.
struct Sums {
    std::vector<double> differences;
    double norm = 0;
    std::size_t points = 0;

    explicit Sums(std::size_t terms = 0) : differences(terms) {}
    void add(const Sums& other) {
        for (std::size_t k = 0; k < differences.size(); ++k) {
            differences[k] += other.differences[k];
        }
        norm += other.norm;
        points += other.points;
    }
    [[nodiscard]] double error(std::size_t k) const {
        return norm > 0 ? std::sqrt(differences[k] / norm) : 0;
    }
};

class Views {
  public:
    Views(const scene::Scene& scene,
          std::span<const bake::CubemapLight> lights,
          const ViewTermsOptions& options)
        : options_(options),
          scene_(scene),
          caster_(scene),
          rows_(caster_, parameters_of(options), lights),
          materials_(bake::mesh_materials(scene,
                                          {},
                                          {.method = factors::Method::svd,
                                           .light = factors::LightModel::natural,
                                           .terms = options.most_terms})),
          light_count_(lights.size()) {}

    // [lights].
    [[nodiscard]] std::vector<Sums> sums_of_view(std::uint32_t view) const {
        const scene::Camera camera =
            camera_of_view(scene_.camera, kFullTurn * view / options_.views, options_.side);
        const std::uint32_t pixels = options_.side * options_.side;
        std::vector<std::vector<Sums>> of_pixels(pixels);
        tbb::parallel_for(std::uint32_t{0}, pixels, [&](std::uint32_t pixel) {
            of_pixels[pixel] = sums_of_pixel(camera, view * pixels + pixel,
                                             pixel % options_.side, pixel / options_.side);
        });
        std::vector<Sums> sums(light_count_, Sums(options_.most_terms));
        for (const std::vector<Sums>& of_pixel : of_pixels) {
            for (std::size_t light = 0; light < of_pixel.size(); ++light) {
                sums[light].add(of_pixel[light]);
            }
        }
        return sums;
    }

  private:
    // None where it sees past the scene.
    [[nodiscard]] std::vector<Sums> sums_of_pixel(const scene::Camera& camera,
                                                  std::uint32_t number,
                                                  std::uint32_t x,
                                                  std::uint32_t y) const {
        const V3f direction = camera.direction_from_pixel(static_cast<float>(x) + 0.5F,
                                                          static_cast<float>(y) + 0.5F);
        const auto hit = caster_.closest_hit(camera.eye(), direction);
        if (!hit) {
            return {};
        }
        const scene::SurfacePoint point =
            scene::surface_point(scene_, hit->mesh, hit->triangle, hit->barycentric, direction);
        const std::uint32_t material = scene_.meshes[hit->mesh].material;
        const brdf::FactoredBrdf& brdf = materials_.factored[material].brdf;
        const std::vector<V3f> colours = factors::lobe_colours(point.bsdf);
        const float footprint =
            2 * hit->distance * camera.tan_half_height() / static_cast<float>(options_.side);
        const auto truth = rows_.reflected(point, footprint, number);
        const auto terms = rows_.terms(point, brdf, footprint, number);
        std::vector<Sums> sums(light_count_, Sums(options_.most_terms));
        for (std::size_t light = 0; light < light_count_; ++light) {
            sums[light].norm = truth[light].dot(truth[light]);
            sums[light].points = 1;
            for (std::size_t k = 0; k < options_.most_terms; ++k) {
                const std::size_t count = std::min(k + 1, terms[light].size());
                const V3d off = towards_viewer(brdf, colours, point.shading.normal, -direction,
                                               std::span(terms[light]).first(count)) -
                                truth[light];
                sums[light].differences[k] = off.dot(off);
            }
        }
        return sums;
    }

    const ViewTermsOptions& options_;
    const scene::Scene& scene_;
    bake::RayCaster caster_;
    PointRows rows_;
    bake::MeshMaterials materials_;
    std::size_t light_count_;
};

}  // namespace

std::vector<ViewTerms> measure_view_terms(const scene::Scene& scene,
                                          std::span<const bake::CubemapLight> lights,
                                          const ViewTermsOptions& options) {
    const Views views(scene, lights, options);
    std::vector<Sums> all(lights.size(), Sums(options.most_terms));
    std::vector<ViewTerms> found(lights.size());
    for (ViewTerms& one : found) {
        one.worst.resize(options.most_terms);
    }
    for (std::uint32_t view = 0; view < options.views; ++view) {
        const std::vector<Sums> sums = views.sums_of_view(view);
        for (std::size_t light = 0; light < lights.size(); ++light) {
            all[light].add(sums[light]);
            for (std::size_t k = 0; k < options.most_terms; ++k) {
                found[light].worst[k] = std::max(found[light].worst[k], sums[light].error(k));
            }
        }
    }
    for (std::size_t light = 0; light < lights.size(); ++light) {
        found[light].points = all[light].points;
        for (std::size_t k = 0; k < options.most_terms; ++k) {
            found[light].errors.push_back(all[light].error(k));
        }
    }
    return found;
}

}  // namespace relume::lab
