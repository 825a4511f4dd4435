// The light of a cubemap as paths look for it: its radiance is constant in every texel, and
// directions are drawn where it is bright.
#pragma once

#include "protocol/light/light_cubemap.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::sampling {

// Immutable and thread-safe.
class TexelLight {
  public:
    explicit TexelLight(light::LightCubemap cubemap);

    [[nodiscard]] const light::LightCubemap& cubemap() const { return cubemap_; }
    // From a direction of any non-zero length.
    [[nodiscard]] Imath::V3f radiance(const Imath::V3f& direction) const;

    struct Sample {
        Imath::V3f direction{0, 0, 1};  // unit
        float pdf = 0;                  // per steradian; 0 where the light is black
    };
    // A texel is drawn by its power, the mean of the colours, and a place in it uniformly over
    // the cube's face. `u_texel` and `u` in [0, 1).
    [[nodiscard]] Sample sample(float u_texel, const Imath::V2f& u) const;
    // Density with which `sample` returns the unit direction.
    [[nodiscard]] float pdf(const Imath::V3f& direction) const;

  private:
    [[nodiscard]] float pdf_in_texel(std::size_t texel, const Imath::V3f& direction) const;

    light::LightCubemap cubemap_;
    std::vector<double> cumulative_;  // by texel; the last is 1, or 0 where all is black
    std::vector<float> probability_;
};

}  // namespace relume::sampling
