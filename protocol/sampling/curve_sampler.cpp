#include "protocol/sampling/curve_sampler.h"

#include "protocol/curve/curve_angle.h"
#include "protocol/sampling/sobol.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::sampling {
namespace {

Imath::V3f cosine_direction(const Imath::V2f& u) {
    const float radius = std::sqrt(u.x);
    const float phi = 2 * std::numbers::pi_v<float> * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0F, 1 - u.x))};
}

bool is_black(const Imath::V3f& colour) {
    return colour.x == 0 && colour.y == 0 && colour.z == 0;
}

}  // namespace

CurveSampler::CurveSampler(const CurvePoint& point,
                           const CurveOfBrdf& edited,
                           const TexelLight& light,
                           const std::array<std::uint32_t, kWays.size()>& counts)
    : point_(point),
      edited_(edited),
      light_(light),
      counts_{static_cast<float>(counts[0]), static_cast<float>(counts[1]),
              static_cast<float>(counts[2])},
      angle_(edited.angle() == curve::CurveAngle::reflection ? SampledAngle::reflection
                                                             : SampledAngle::half) {}

bool CurveSampler::draw(Way way, std::uint32_t index, std::uint64_t key) {
    const Imath::V2f u = sobol_point(index, key);
    if (way == Way::by_light) {
        const TexelLight::Sample sample = light_.sample(sobol_point(index, key + 1).x, u);
        world_ = sample.direction;
        wi_ = point_.shading.local_from_world(world_);
        if (sample.pdf <= 0) {
            return false;
        }
    } else {
        wi_ =
            way == Way::by_angle ? sample_angle(angle_, point_.wo, u).wi : cosine_direction(u);
        world_ = point_.shading.world_from_local(wi_);
    }
    return wi_.z > 0 && world_.dot(point_.geometric_normal) > 0;
}

bool CurveSampler::reflects() {
    diffuse_ = point_.diffuse.times_cosine(wi_.z, point_.wo.z);
    curve_ = edited_.brdf.quotient(edited_.curve, wi_, point_.wo) * edited_.tint * wi_.z;
    return !is_black(diffuse_) || !is_black(curve_);
}

float CurveSampler::density() const {
    return counts_[0] * angle_pdf(angle_, wi_, point_.wo) + counts_[1] * light_.pdf(world_) +
           counts_[2] * wi_.z * std::numbers::inv_pi_v<float>;
}

void CurveSampler::add(const Imath::V3f& radiance, CurveShares& shares) const {
    const Imath::V3f weight = radiance / density();
    shares.diffuse += weight * diffuse_;
    const Imath::V3f value = weight * curve_;
    const curve::CurvePlace place =
        curve::curve_place(curve::u_from_directions(edited_.angle(), wi_, point_.wo));
    for (std::size_t c = 0; c < 3; ++c) {
        const float of_colour = value[static_cast<int>(c)];
        shares.samples[c][place.sample] += (1 - place.fraction) * of_colour;
        shares.samples[c][place.sample + 1] += place.fraction * of_colour;
    }
}

}  // namespace relume::sampling
