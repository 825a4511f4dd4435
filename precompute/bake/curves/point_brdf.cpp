#include "precompute/bake/curves/point_brdf.h"

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

// Averages of the same colour over places of a surface differ by rounding.
constexpr float kRounding = 1e-5F;

bool is_same(float a, double b) {
    return std::abs(a - static_cast<float>(b)) <= kRounding * std::max(1.0F, std::abs(a));
}

bool is_same(const Imath::V3f& a, const Imath::V3d& b) {
    return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

Imath::V3f ratio(const Imath::V3f& of_point, const Imath::V3d& of_material) {
    Imath::V3f ratio(1, 1, 1);
    for (int c = 0; c < 3; ++c) {
        if (of_material[c] > 0) {
            ratio[c] = of_point[c] / static_cast<float>(of_material[c]);
        }
    }
    return ratio;
}

}  // namespace

PointBrdf::PointBrdf(const EditedMaterial& material, const scene::Bsdf& at_point)
    : material_(material) {
    if (!material.is_of_scene) {
        return;
    }
    const curve::ParameterValues& values = material.brdf.parameters();
    switch (material.brdf.model()) {
        case curve::CurveModel::phong:
            if (!is_same(at_point.specular_colour(), values[0])) {
                tint_ = ratio(at_point.specular_colour(), values[0]);
            }
            break;
        case curve::CurveModel::ggx:
            if (material.angle() == curve::CurveAngle::half) {
                if (!is_same(at_point.specular_colour(), values[0]) ||
                    !is_same(at_point.grazing(), values[1].x)) {
                    own_ = curve::CurveBrdf::ggx(at_point.specular_colour(), at_point.grazing(),
                                                 static_cast<float>(values[2].x));
                }
            } else {
                if (!is_same(at_point.specular_colour(), values[0])) {
                    tint_ = ratio(at_point.specular_colour(), values[0]);
                }
                if (!is_same(at_point.alpha(), values[2].x)) {
                    own_ = curve::CurveBrdf::ggx(Imath::V3f(values[0]),
                                                 static_cast<float>(values[1].x),
                                                 at_point.alpha());
                }
            }
            break;
        case curve::CurveModel::cook_torrance:
        case curve::CurveModel::ashikhmin_shirley:
        case curve::CurveModel::measured:
            break;
    }
}

std::string left_out_by_curve(const scene::Material& material, const EditedMaterial& edited) {
    if (!edited.is_of_scene) {
        return {};
    }
    if (material.model == scene::BsdfModel::phong && material.exponent_texture) {
        return "exponent";
    }
    const bool has_roughness = material.surface_texture || material.gloss_texture;
    if (material.model == scene::BsdfModel::ggx && has_roughness &&
        edited.angle() == curve::CurveAngle::half) {
        return "roughness";
    }
    return {};
}

}  // namespace relume::bake
