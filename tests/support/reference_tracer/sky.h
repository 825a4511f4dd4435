// Light from infinitely far away, and how to sample it.
#pragma once

#include "tests/support/reference_tracer/random.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace relume::reference {

struct SkySample {
    Imath::V3d direction{0, 1, 0};
    double density = 0;  // per steradian
};

class Sky {
  public:
    using Radiance = std::function<Imath::V3d(const Imath::V3d& unit_direction)>;

    // Piecewise constant: `rgb` holds 6·n² texels in the order of protocol/basis/cubemap.h.
    [[nodiscard]] static Sky from_cubemap(std::uint32_t n, std::span<const Imath::V3f> rgb);
    // Any function, non-negative; `n` is the resolution of the table that guides the samples.
    [[nodiscard]] static Sky from_function(std::uint32_t n, Radiance radiance);

    [[nodiscard]] Imath::V3d radiance(const Imath::V3d& direction) const;
    [[nodiscard]] SkySample sampled(Random& random) const;
    [[nodiscard]] double density(const Imath::V3d& direction) const;

  private:
    Sky(std::uint32_t n, Radiance radiance, std::vector<double> importance);

    std::uint32_t n_;
    Radiance radiance_;
    std::vector<double> probability_;  // of each texel
    std::vector<double> cumulative_;
};

}  // namespace relume::reference
