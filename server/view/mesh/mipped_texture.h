// A texture of the surface, averaged over what a pixel sees of it.
#pragma once

#include "protocol/transport/surface_textures.h"

#include <Imath/ImathVec.h>
#include <Imath/half.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::view {

// Keeps a reference to the texture. Immutable; safe to share between threads.
class MippedTexture {
  public:
    explicit MippedTexture(const transport::SurfaceTexture& texture);

    // The mean over about the parallelogram around `uv` that these two vectors span: up to
    // four places along its longer side, each as wide as the shorter one. Finite wherever it
    // is.
    [[nodiscard]] Imath::V3f mean(const Imath::V2f& uv,
                                  const Imath::V2f& across,
                                  const Imath::V2f& along) const;

    // Bytes of what it holds beside the texture.
    [[nodiscard]] std::size_t bytes() const;

  private:
    // Red, green and blue; the fourth pads, so that a texel is one vector.
    struct alignas(16) Texel {
        std::array<float, 4> rgb{};
    };
    // Half as wide and high as the one before, rounded down, and at least one texel.
    struct Level {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<Texel> texels;  // of the first level none: those are the texture's own
    };
    // The texels of a level around a place, and how much of the right and lower ones counts.
    struct Corner {
        std::array<std::uint32_t, 2> columns{};
        std::array<std::uint32_t, 2> rows{};
        float right_share = 0;
        float lower_share = 0;
    };

    [[nodiscard]] Corner corner_at(const Level& level, const Imath::V2f& uv) const;
    // Adds `weight` times the texture at a place.
    void add_bilinear(std::size_t level, const Imath::V2f& uv, float weight, Texel& sum) const;
    void add_trilinear(float level, const Imath::V2f& uv, float weight, Texel& sum) const;

    const transport::SurfaceTexture& texture_;
    std::vector<Level> levels_;
};

}  // namespace relume::view
