#include "precompute/bake/curves/curve_estimator.h"

#include "precompute/bake/curves/angle_sampling.h"
#include "precompute/bake/rays/sobol.h"
#include "protocol/curve/curve_angle.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relume::bake {
namespace {

enum Way : std::uint8_t { kByAngle, kByLight, kByCosine, kWays };
constexpr std::array<std::uint32_t, kWays> kSamplesOfWay{12, 6, 3};

Imath::V3f cosine_direction(const Imath::V2f& u) {
    const float radius = std::sqrt(u.x);
    const float phi = 2 * std::numbers::pi_v<float> * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0F, 1 - u.x))};
}

// f·cos θ of the diffuse lobe.
Imath::V3f diffuse_times_cosine(const scene::Bsdf& bsdf,
                                const Imath::V3f& wi,
                                const Imath::V3f& wo) {
    float diffuse = 0;
    float specular = 0;
    float grazing = 0;
    bsdf.evaluate_lobes_times_cosine(wo, {{&wi.x, 1}, {&wi.y, 1}, {&wi.z, 1}},
                                     {{&diffuse, 1}, {&specular, 1}, {&grazing, 1}});
    return bsdf.diffuse_colour() * diffuse;
}

bool is_black(const Imath::V3f& colour) {
    return colour.x == 0 && colour.y == 0 && colour.z == 0;
}

// One of the points of a surface, to be sampled.
class SampledPoint {
  public:
    SampledPoint(const scene::SurfacePoint& point,
                 const EditedMaterial& material,
                 const TexelLight& light,
                 const std::array<std::uint32_t, kWays>& counts)
        : point_(point),
          material_(material),
          light_(light),
          counts_(counts),
          angle_(material.angle() == curve::CurveAngle::reflection ? SampledAngle::reflection
                                                                   : SampledAngle::half) {}

    // Number `index` of `key` of the ways' sequences; false where it counts for nothing.
    bool draw(Way way, std::uint32_t index, std::uint64_t key) {
        const Imath::V2f u = sobol_point(index, key);
        if (way == kByLight) {
            const TexelLight::Sample sample = light_.sample(sobol_point(index, key + 1).x, u);
            world_ = sample.direction;
            wi_ = point_.shading.to_local(world_);
            if (sample.pdf <= 0) {
                return false;
            }
        } else {
            wi_ = way == kByAngle ? sample_angle(angle_, point_.wo, u).wi : cosine_direction(u);
            world_ = point_.shading.to_world(wi_);
        }
        if (wi_.z <= 0 || !point_.is_above_surface(world_)) {
            return false;
        }
        diffuse_ = material_.albedo
                       ? *material_.albedo * (wi_.z * std::numbers::inv_pi_v<float>)
                       : diffuse_times_cosine(point_.bsdf, wi_, point_.wo);
        curve_ = material_.brdf.quotient(material_.curve, wi_, point_.wo) * wi_.z;
        return !is_black(diffuse_) || !is_black(curve_);
    }

    [[nodiscard]] const Imath::V3f& direction() const { return world_; }

    // Of the direction that was drawn, from which `radiance` comes.
    void add(const Imath::V3f& radiance, CurveShares& shares) const {
        const float density =
            static_cast<float>(counts_[kByAngle]) * angle_pdf(angle_, wi_, point_.wo) +
            static_cast<float>(counts_[kByLight]) * light_.pdf(world_) +
            static_cast<float>(counts_[kByCosine]) * wi_.z * std::numbers::inv_pi_v<float>;
        const Imath::V3f weight = radiance / density;
        shares.diffuse += weight * diffuse_;
        const Imath::V3f value = weight * curve_;
        const curve::CurvePlace place =
            curve::curve_place(curve::u_from_directions(material_.angle(), wi_, point_.wo));
        for (std::size_t c = 0; c < 3; ++c) {
            const float of_colour = value[static_cast<int>(c)];
            shares.samples[c][place.sample] += (1 - place.fraction) * of_colour;
            shares.samples[c][place.sample + 1] += place.fraction * of_colour;
        }
    }

  private:
    const scene::SurfacePoint& point_;
    const EditedMaterial& material_;
    const TexelLight& light_;
    const std::array<std::uint32_t, kWays>& counts_;
    SampledAngle angle_;
    Imath::V3f wi_{0, 0, 0};
    Imath::V3f world_{0, 0, 0};
    Imath::V3f diffuse_{0, 0, 0};
    Imath::V3f curve_{0, 0, 0};
};

}  // namespace

void CurveEstimator::estimate(const ReceiverSurface& surface,
                              const SequencePlace& place,
                              const EditedMaterial& material,
                              CurveShares& shares,
                              std::uint64_t& rays) const {
    shares = {};
    const std::size_t points = std::max<std::size_t>(surface.turns.size(), 1);
    std::array<std::uint32_t, kWays> counts{};
    for (std::size_t way = 0; way < kWays; ++way) {
        // As many from each of the points, so that all of them count alike.
        const auto each = static_cast<std::uint32_t>(
            std::lround(surface.share * static_cast<float>(samples_ * kSamplesOfWay[way]) /
                        static_cast<float>(points)));
        counts[way] = std::max(each, 1U) * static_cast<std::uint32_t>(points);
    }
    const std::uint64_t surface_key = transport::mix_bits(seed_ + 5) + surface.number;
    for (std::uint8_t way = 0; way < kWays; ++way) {
        const std::uint64_t key = transport::mix_bits(surface_key) + 16 * std::uint64_t{way};
        const std::uint32_t first = place.run * samples_ * kSamplesOfWay[way];
        for (std::uint32_t i = 0; i < counts[way]; ++i) {
            const scene::SurfacePoint& point =
                surface.turns.empty() ? surface.point : surface.turns[i % points];
            const Imath::V3f origin =
                surface.turns.empty() ? surface.origins[i % kPacketSize] : offset_origin(point);
            SampledPoint sampled(point, material, radiance_.light(), counts);
            if (sampled.draw(static_cast<Way>(way), first + i, key)) {
                sampled.add(radiance_.incoming(origin, sampled.direction(),
                                               {.index = first + i, .key = key + 2}, rays),
                            shares);
            }
        }
    }
}

}  // namespace relume::bake
