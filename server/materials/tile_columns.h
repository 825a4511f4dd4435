// The columns of one curve of one material, in one tile of the image, under one light: what
// each of the tile's pixels shows of every sample of the curve.
#pragma once

#include "protocol/curve/curve.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::materials {

// As they are estimated: of `pixels` pixels.
struct ColumnValues {
    explicit ColumnValues(std::size_t count)
        : pixels(count),
          samples(3 * curve::kCurveSamples * count),
          diffuse(3 * count),
          baked(3 * count) {}

    std::size_t pixels;
    std::vector<float> samples;  // [3][kCurveSamples][pixels]
    std::vector<float> diffuse;  // [3][pixels]: what the diffuse part shows
    std::vector<float> baked;    // [3][pixels]: what the specular part shows, all as baked

    [[nodiscard]] float* column(std::size_t channel, std::size_t sample) {
        return &samples[(channel * curve::kCurveSamples + sample) * pixels];
    }
};

// Kept in 16 bits a value, to 1/65,534 of the largest of its column in the tile. All 256
// columns are multiplied at once: a material's fit into an image's time, so that nothing is
// chosen and every image of an edited curve is the whole product. Immutable and thread-safe.
class TileColumns {
  public:
    // `slots`: of the pixels in the tile.
    TileColumns(std::vector<std::uint8_t> slots, ColumnValues values);

    [[nodiscard]] std::span<const std::uint8_t> slots() const { return slots_; }
    // By how much the pixels differ from those of the bake where the curve is this and the
    // diffuse part is multiplied so: interleaved, [pixels][3].
    void change(const curve::Curve& curve,
                const Imath::V3f& diffuse,
                std::span<float> rgb) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::vector<std::uint8_t> slots_;
    std::vector<std::int16_t> quantised_;                             // as ColumnValues
    std::array<std::array<float, curve::kCurveSamples>, 3> steps_{};  // of a column
    std::vector<float> diffuse_;
    std::vector<float> baked_;
};

}  // namespace relume::materials
