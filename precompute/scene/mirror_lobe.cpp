#include "precompute/scene/mirror_lobe.h"

#include <algorithm>
#include <cmath>

namespace relume::scene {

Imath::V3f mirror_direction(const SurfacePoint& point) {
    return point.shading.to_world({-point.wo.x, -point.wo.y, point.wo.z});
}

float lobe_width(const SurfacePoint& point) {
    constexpr float kLeastCosine = 0.1F;
    const Bsdf& bsdf = point.bsdf;
    return bsdf.model() == BsdfModel::ggx
               ? 2.0F * bsdf.alpha() * std::max(point.wo.z, kLeastCosine)
               : std::sqrt(2.0F / (bsdf.exponent() + 2.0F));
}

}  // namespace relume::scene
