#include "precompute/materials/field_model.h"

#include "protocol/brdf/local_frame.h"
#include "protocol/tripling/material_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace relume::materials {
namespace {

// Of a viewer at the horizon.
constexpr float kLeastCosine = 0.02F;

Imath::V3f viewer_above_horizon(const Imath::V3f& normal, const Imath::V3f& reflection) {
    const Imath::V3f viewer = tripling::mirrored(reflection, normal);
    const float cosine = viewer.dot(normal);
    if (cosine >= kLeastCosine) {
        return viewer;
    }
    const Imath::V3f along = viewer - normal * cosine;
    const float length = along.length();
    const Imath::V3f tangent =
        length > 1e-6F ? along / length : brdf::local_frame(normal).tangent;
    return tangent * std::sqrt(1 - kLeastCosine * kLeastCosine) + normal * kLeastCosine;
}

}  // namespace

FieldModel lambert_model() {
    return {.name = "lambert",
            .lobe_count = 1,
            .depends_on_normal = true,
            .depends_on_reflection = false,
            .width_rad = 1,
            .colours = {Imath::V3f(1)},
            .evaluate = [](const Imath::V3f& normal, const Imath::V3f& /*reflection*/,
                           const brdf::Directions& light, std::span<float> out) {
                for (std::size_t i = 0; i < light.size(); ++i) {
                    const float cosine =
                        light.x[i] * normal.x + light.y[i] * normal.y + light.z[i] * normal.z;
                    out[i] = std::max(cosine, 0.0F) / std::numbers::pi_v<float>;
                }
            }};
}

FieldModel phong_model(float exponent) {
    return {.name = "phong",
            .lobe_count = 1,
            .depends_on_normal = false,
            .depends_on_reflection = true,
            .width_rad = std::acos(std::exp2(-1.0 / std::max(1.0F, exponent))),
            .colours = {Imath::V3f(1)},
            .evaluate = [exponent](const Imath::V3f& /*normal*/, const Imath::V3f& reflection,
                                   const brdf::Directions& light, std::span<float> out) {
                const float scale = (exponent + 1) / (2 * std::numbers::pi_v<float>);
                for (std::size_t i = 0; i < light.size(); ++i) {
                    const float cosine = light.x[i] * reflection.x + light.y[i] * reflection.y +
                                         light.z[i] * reflection.z;
                    out[i] = cosine > 0 ? scale * std::pow(cosine, exponent) : 0;
                }
            }};
}

FieldModel lobes_model(std::string name, factors::BrdfLobes lobes) {
    const std::size_t count = lobes.count();
    const double width_rad = lobes.width_rad;
    std::vector<Imath::V3f> colours = lobes.mean_colours;
    return {.name = std::move(name),
            .lobe_count = count,
            .depends_on_normal = true,
            .depends_on_reflection = true,
            .width_rad = width_rad,
            .colours = std::move(colours),
            .evaluate = [lobes = std::move(lobes), count](
                            const Imath::V3f& normal, const Imath::V3f& reflection,
                            const brdf::Directions& light, std::span<float> out) {
                const brdf::Frame frame = brdf::local_frame(normal);
                const Imath::V3f viewer =
                    frame.local_from_world(viewer_above_horizon(normal, reflection));
                std::vector<std::size_t> above;
                std::vector<float> x, y, z;
                for (std::size_t i = 0; i < light.size(); ++i) {
                    const Imath::V3f local =
                        frame.local_from_world({light.x[i], light.y[i], light.z[i]});
                    if (local.z > 0) {
                        above.push_back(i);
                        x.push_back(local.x);
                        y.push_back(local.y);
                        z.push_back(local.z);
                    }
                }
                std::vector<float> values(count * above.size());
                lobes.evaluate(viewer, {x, y, z}, values);
                std::fill(out.begin(), out.end(), 0.0F);
                for (std::size_t lobe = 0; lobe < count; ++lobe) {
                    for (std::size_t i = 0; i < above.size(); ++i) {
                        out[lobe * light.size() + above[i]] =
                            values[lobe * above.size() + i] * z[i];
                    }
                }
            }};
}

}  // namespace relume::materials
