// What a place of a surface shows of every sample of a curve of its BRDF, and of its diffuse
// colour: estimated from directions that are drawn in three ways, joined by the balance
// heuristic [Veach97]: evenly over the samples of the curve (angle_sampling.h), by the power of
// the light, and by the cosine. So every sample gets its share whatever the light is, a small
// bright light is found whatever the curve is, and the estimate is unbiased for every curve.
#pragma once

#include "protocol/brdf/diffuse_lobe.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/curve/curve.h"
#include "protocol/curve/curve_brdf.h"
#include "protocol/sampling/angle_sampling.h"
#include "protocol/sampling/texel_light.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::sampling {

// Radiance to the viewer is diffuse + Σ_k sample_k · c_k + what nobody edits.
struct CurveShares {
    Imath::V3f diffuse{0, 0, 0};  // of the diffuse colour as it is
    std::array<std::array<float, curve::kCurveSamples>, 3> samples{};  // red, green and blue
};

// A place as its light meets it.
struct CurvePoint {
    brdf::Frame shading;
    Imath::V3f geometric_normal{0, 0, 1};  // light from below it counts for nothing
    Imath::V3f wo{0, 0, 1};                // to the viewer, in `shading`, z > 0
    brdf::DiffuseLobe diffuse;
};

// The curve that is edited, and what it is multiplied with.
struct CurveOfBrdf {
    const curve::CurveBrdf& brdf;
    std::size_t curve = 0;
    Imath::V3f tint{1, 1, 1};  // what scales the curve at this place

    [[nodiscard]] curve::CurveAngle angle() const { return brdf.curves()[curve].angle; }
};

enum class Way : std::uint8_t { by_angle, by_light, by_cosine };
inline constexpr std::array<Way, 3> kWays{Way::by_angle, Way::by_light, Way::by_cosine};
// How many directions of each way are drawn for one path of a bake of light.
inline constexpr std::array<std::uint32_t, kWays.size()> kDirectionsOfWay{12, 6, 3};

// Draws directions from one place, each worth its part of the whole estimate.
class CurveSampler {
  public:
    // `counts`: how many directions of each way the whole estimate has, by all its places.
    // Keeps references to the first three.
    CurveSampler(const CurvePoint& point,
                 const CurveOfBrdf& edited,
                 const TexelLight& light,
                 const std::array<std::uint32_t, kWays.size()>& counts);

    // Direction `index` of sequence `key` of the ways' sequences; false where it lies below the
    // surface.
    [[nodiscard]] bool draw(Way way, std::uint32_t index, std::uint64_t key);
    // Of the direction that was drawn: unit, in the world, and in the frame of shading.
    [[nodiscard]] const Imath::V3f& direction() const { return world_; }
    [[nodiscard]] const Imath::V3f& local_direction() const { return wi_; }
    // How many directions of the whole estimate there are a steradian around it.
    [[nodiscard]] float density() const;
    // Whether anything that comes from there is seen.
    [[nodiscard]] bool reflects();
    // Adds what `radiance` from there shows. Of a direction that reflects.
    void add(const Imath::V3f& radiance, CurveShares& shares) const;

  private:
    const CurvePoint& point_;
    const CurveOfBrdf& edited_;
    const TexelLight& light_;
    std::array<float, kWays.size()> counts_;
    SampledAngle angle_;
    Imath::V3f wi_{0, 0, 0};
    Imath::V3f world_{0, 0, 0};
    Imath::V3f diffuse_{0, 0, 0};
    Imath::V3f curve_{0, 0, 0};
};

}  // namespace relume::sampling
