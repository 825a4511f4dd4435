#include "tests/lab/triple/triple_light.h"

#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"
#include "tests/lab/triple/tabulated_material.h"

#include <cstddef>
#include <utility>

namespace relume::lab {

TripleLight::TripleLight(std::uint32_t face_resolution,
                         std::array<std::vector<float>, 3> texels)
    : n_(face_resolution), texels_(std::move(texels)), table_(face_resolution) {
    constexpr std::array<float, 3> kWeights{0.2126F, 0.7152F, 0.0722F};
    luminance_.assign(texels_[0].size(), 0.0F);
    for (std::size_t c = 0; c < 3; ++c) {
        block_texels_[c] = tripling::values_in_blocks(n_, texels_[c]);
        coefficients_[c] = texels_[c];
        basis::haar_forward_cubemap(n_, coefficients_[c]);
        for (std::size_t i = 0; i < luminance_.size(); ++i) {
            luminance_[i] += kWeights[c] * coefficients_[c][i];
        }
        texels_[c].resize(block_texels_[c].size(), 0.0F);
    }
    table_.set({coefficients_[0], coefficients_[1], coefficients_[2]});
}

engine::ColourPlanes TripleLight::block_planes() const {
    return {block_texels_[0].data(), block_texels_[1].data(), block_texels_[2].data()};
}

engine::ColourPlanes TripleLight::planes() const {
    return {texels_[0].data(), texels_[1].data(), texels_[2].data()};
}

tripling::SquareSet TripleLight::largest(double fraction) const {
    return tripling::largest_squares(n_, luminance_, terms_of_fraction(n_, fraction),
                                     tripling::TermOrder::by_area);
}

}  // namespace relume::lab
