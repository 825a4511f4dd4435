// A texture of the surface, averaged over what a pixel sees of it.
#pragma once

#include "protocol/transport/surface_textures.h"

#include <Imath/ImathVec.h>
#include <Imath/half.h>

#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// Keeps a reference to the texture. Immutable; safe to share between threads.
class MippedTexture {
  public:
    explicit MippedTexture(const transport::SurfaceTexture& texture);

    // The mean over about the parallelogram around `uv` that these two vectors span: up to
    // eight places along its longer side, each as wide as the shorter one. Finite wherever it
    // is.
    [[nodiscard]] Imath::V3f mean(const Imath::V2f& uv,
                                  const Imath::V2f& across,
                                  const Imath::V2f& along) const;

    // Bytes of what it holds beside the texture.
    [[nodiscard]] std::size_t bytes() const;

  private:
    // Half as wide and high as the one before, rounded down, and at least one texel.
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::span<const half> rgb;
    };

    [[nodiscard]] Imath::V3f bilinear(std::size_t level, const Imath::V2f& uv) const;
    [[nodiscard]] Imath::V3f trilinear(float level, const Imath::V2f& uv) const;

    const transport::SurfaceTexture& texture_;
    std::vector<std::vector<half>> smaller_;
    std::vector<Level> levels_;
};

}  // namespace relume::view
