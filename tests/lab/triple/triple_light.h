// A light as the compared ways to integrate read it.
#pragma once

#include "protocol/tripling/square_set.h"
#include "server/engine/kernels/open_texels.h"
#include "server/engine/kernels/triple_product.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relume::lab {

// Three colours of a light, 6·n² each, in the order of cubemap.h: as texels, and what the ways
// read.
class TripleLight {
  public:
    TripleLight(std::uint32_t face_resolution, std::array<std::vector<float>, 3> texels);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] const engine::LightTable& table() const { return table_; }
    [[nodiscard]] const std::array<std::vector<float>, 3>& coefficients() const {
        return coefficients_;
    }
    // Of texels in squares (texel_blocks.h), and in the order of cubemap.h.
    [[nodiscard]] engine::ColourPlanes block_planes() const;
    [[nodiscard]] engine::ColourPlanes planes() const;
    // The squares of the largest wavelets of its luminance, weighted by area [Ng03 §4.1].
    [[nodiscard]] tripling::SquareSet largest(double fraction) const;

  private:
    std::uint32_t n_;
    std::array<std::vector<float>, 3> texels_;
    std::array<std::vector<float>, 3> block_texels_;
    std::array<std::vector<float>, 3> coefficients_;
    std::vector<float> luminance_;  // coefficients
    engine::LightTable table_;
};

}  // namespace relume::lab
