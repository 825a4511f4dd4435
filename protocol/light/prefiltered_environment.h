// A source map resampled once so that turning it is cheap and keeps the energy of its suns.
#pragma once

#include "protocol/light/environment_map.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::light {

// For lighting cubemaps of one resolution n. Holds a cubemap of side m = 4n,
// low-passed and sharpened (README.md says why), every face with a border of one texel taken
// from its neighbours so that bilinear lookups run across edges. 1.2 kB per n², which is 4.8 MB
// for n = 64. Immutable once made; any number of threads may read it.
class PrefilteredEnvironment {
  public:
    // protocol/light.md's; any other is there to be measured.
    static constexpr float kSharpening = 0.16F;

    // Takes tens to hundreds of milliseconds, on all cores TBB has.
    // Throws std::invalid_argument unless basis::is_face_resolution(face_resolution).
    PrefilteredEnvironment(std::shared_ptr<const EnvironmentMap> source,
                           std::uint32_t face_resolution,
                           float sharpening = kSharpening);

    [[nodiscard]] const EnvironmentMap& source() const { return *source_; }
    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }

    [[nodiscard]] std::uint32_t inner_resolution() const { return inner_resolution_; }
    // Row-major, RGB, 6·(m+2)² texels and one value more, so that four floats can be read from
    // any texel; texel (row, column) of a face lies at (face·(m+2) + row + 1)·(m+2) + column
    // + 1.
    [[nodiscard]] std::span<const float> padded_texels() const { return texels_; }

  private:
    std::shared_ptr<const EnvironmentMap> source_;
    std::uint32_t face_resolution_;
    std::uint32_t inner_resolution_;
    std::vector<float> texels_;
};

}  // namespace relume::light
