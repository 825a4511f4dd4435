// From the sums of a block to its pixels.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>

namespace relume::view {

// A block's part of an image, RGB interleaved.
struct BlockPixels {
    float* first;            // of the upper left pixel
    std::size_t row_floats;  // from a row of the image to the next
    std::uint32_t columns;   // 1 … 16
    std::uint32_t rows;
};

// Pixels are the receivers of sums [3][256] (protocol/transport/block_basis.h) times tint
// [3][256], in that order of operations: the same bits on every instruction set as
// transport::block_receivers_from_coefficients and a multiplication.
void write_block_pixels(const float* sums, const float* tint, const BlockPixels& pixels);

}  // namespace relume::view
