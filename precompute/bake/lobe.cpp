#include "precompute/bake/lobe.h"

#include <algorithm>
#include <cmath>

namespace relume::bake {

Imath::V3f mirror_direction(const scene::SurfacePoint& point) {
    return point.shading.to_world({-point.wo.x, -point.wo.y, point.wo.z});
}

float lobe_width(const scene::SurfacePoint& point) {
    constexpr float kLeastCosine = 0.1F;
    const scene::Bsdf& bsdf = point.bsdf;
    return bsdf.model() == scene::BsdfModel::ggx
               ? 2.0F * bsdf.alpha() * std::max(point.wo.z, kLeastCosine)
               : std::sqrt(2.0F / (bsdf.exponent() + 2.0F));
}

}  // namespace relume::bake
