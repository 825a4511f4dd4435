// Cubemaps whose faces carry a border of one texel, so that what is done between neighbouring
// texels needs no case for the edges. Internal to protocol/light.
#pragma once

#include "protocol/basis/cubemap.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::light {

// The texel that touches (row, column) of `face` from the other side of an edge, exactly one of
// row and column being -1 or n. Texels that touch along an edge have equal positions along it,
// so bilinear lookups over such a border agree on both sides of the edge.
[[nodiscard]] basis::Texel texel_past_edge(std::uint32_t n,
                                           basis::Face face,
                                           int row,
                                           int column);

// A view of 6·(m+2)² texels of `channels` floats; rows and columns run from -1 to m.
class PaddedCubemap {
  public:
    PaddedCubemap(std::span<float> values, std::uint32_t m, std::size_t channels)
        : values_(values), m_(m), channels_(channels) {}

    [[nodiscard]] static std::size_t value_count(std::uint32_t m, std::size_t channels) {
        return std::size_t{basis::kFaceCount} * (m + 2) * (m + 2) * channels;
    }

    [[nodiscard]] float* at(basis::Face face, int row, int column) const {
        const std::size_t side = m_ + 2;
        const std::size_t line =
            static_cast<std::size_t>(face) * side + static_cast<std::size_t>(row + 1);
        return &values_[(line * side + static_cast<std::size_t>(column + 1)) * channels_];
    }

    // Borders become copies of the texels past the edge. At a corner three faces meet, and the
    // mean of their three texels makes all of them agree at the point.
    void fill_borders() const;
    // The transpose: what was added to the borders moves to the texels they stand for.
    void fold_borders() const;

  private:
    template <typename Edge, typename Corner>
    void for_each_border_texel(Edge edge, Corner corner) const;

    std::span<float> values_;
    std::uint32_t m_;
    std::size_t channels_;
};

}  // namespace relume::light
