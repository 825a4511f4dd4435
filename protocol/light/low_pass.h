// Mean over a round, smooth kernel of constant angular size. Internal to protocol/light.
#pragma once

#include "protocol/basis/cubemap.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::light {

// Normalised convolution, Σ k·energy / Σ k·solid angle with k = (1 − r²/R²)³: a constant stays
// constant, and texels that hold no part of the source count for nothing instead of as black.
class LowPass {
  public:
    // `bins` as from splat_source for side m; R in radians, up to half a radian.
    LowPass(std::vector<float> bins, std::uint32_t m, float radius);

    // At the centre of a texel. Any number of threads may call it.
    [[nodiscard]] Imath::V3f filter(const basis::Texel& texel) const;

  private:
    void add_face(const Imath::V3f& centre, basis::Face face, float sum[4]) const;

    std::uint32_t m_;
    float radius_;
    float sin_radius_;
    // x, y, z of the directions and red, green, blue, solid angle of the bins, each plane
    // padded at its end for reads of whole vectors.
    std::vector<float> planes_[7];
};

// Texels [begin, end) of consecutive rows of one face; the inner loop, for several vector
// widths.
struct LowPassWindow {
    const float* planes[7];  // at the face's first texel
    std::size_t row_stride;
    std::uint32_t first_row;
    std::uint32_t end_row;
    std::uint32_t first_column;
    std::uint32_t end_column;
    float inverse_radius_sq;
};

// Adds Σ k·bin over the window to sum.
void add_window(const LowPassWindow& window, const Imath::V3f& centre, float sum[4]);

}  // namespace relume::light
