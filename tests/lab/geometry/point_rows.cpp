#include "tests/lab/geometry/point_rows.h"

#include "protocol/brdf/local_frame.h"

#include <algorithm>
#include <utility>

namespace relume::lab {

using Imath::V3d;
using Imath::V3f;

PointRows::PointRows(const bake::RayCaster& caster,
                     const bake::BakeParameters& parameters,
                     std::span<const bake::CubemapLight> lights)
    : texels_(parameters.face_resolution, parameters.seed),
      tracer_(caster, parameters),
      rows_(caster, texels_, parameters) {
    for (const bake::CubemapLight& light : lights) {
        auto& coefficients = coefficients_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            coefficients[c].resize(rows_.projection().basis().coefficient_count());
            rows_.projection().project_radiance(light[c], coefficients[c]);
        }
    }
}

std::vector<std::vector<V3d>> PointRows::terms(const scene::SurfacePoint& point,
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
    surface.footprint = footprint;
    surface.origins.fill(bake::offset_origin(point));
    surface.brdf = &brdf;
    return lit(std::move(surface), number);
}

std::vector<V3d> PointRows::reflected(const scene::SurfacePoint& point,
                                      float footprint,
                                      std::uint32_t number) const {
    bake::ReceiverSurface surface;
    surface.point = point;
    surface.point.geometric_normal = point.shading.normal;
    surface.footprint = footprint;
    surface.origins.fill(bake::offset_origin(point));
    std::vector<V3d> radiance;
    for (const std::vector<V3d>& of_light : lit(std::move(surface), number)) {
        radiance.push_back(of_light.front());
    }
    return radiance;
}

std::vector<std::vector<V3d>> PointRows::lit(bake::ReceiverSurface surface,
                                             std::uint32_t number) const {
    surface.share = 1;
    Scratch& scratch = scratches_.local();
    rows_.bake(tracer_.trace({.index = number,
                              .place = {.run = number,
                                        .along = 0.7548776662466927 * number,
                                        .across = 0.5698402909980532 * number},
                              .surfaces = {std::move(surface)}}),
               nullptr, scratch.rows, scratch.baking);
    std::vector<std::vector<V3d>> lit;
    for (const auto& coefficients : coefficients_) {
        std::vector<V3d>& radiance = lit.emplace_back(scratch.rows.size(), V3d(0));
        for (std::size_t k = 0; k < radiance.size(); ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::vector<float>& row = scratch.rows[k].rgb[c];
                double sum = 0;
                for (std::size_t j = 0; j < row.size(); ++j) {
                    sum += double{row[j]} * coefficients[c][j];
                }
                radiance[k][static_cast<int>(c)] = sum;
            }
        }
    }
    return lit;
}

V3d towards_viewer(const brdf::FactoredBrdf& brdf,
                   std::span<const V3f> colours,
                   const V3f& normal,
                   const V3f& to_viewer,
                   std::span<const V3d> terms) {
    V3f local = brdf::local_frame(normal).local_from_world(to_viewer);
    local.z = std::max(local.z, brdf::kLeastViewCosine);
    std::vector<float> h(std::size_t{brdf.terms} * brdf.lobes);
    brdf.h.evaluate(local, h);
    V3d radiance(0);
    for (std::uint32_t lobe = 0; lobe < brdf.lobes; ++lobe) {
        for (std::size_t k = 0; k < terms.size(); ++k) {
            radiance += V3d(colours[lobe]) * double{h[k * brdf.lobes + lobe]} * terms[k];
        }
    }
    return radiance;
}

}  // namespace relume::lab
