// From the sums of a block to its pixels.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>

namespace relume::view {

// Where the pixels of a block lie in an image, RGB interleaved.
struct BlockPixels {
    float* first;            // of the upper left pixel
    std::size_t row_floats;  // from a row of the image to the next
    std::uint32_t columns;   // 1 … 16
    std::uint32_t rows;
};

// Transforms the sums of a block, [3][256], from the basis of the block to its receivers
// (protocol/transport/block_basis.h), multiplies these by the tint, [3][256], and writes them
// as pixels. Every instruction set gives the bits of
// transport::block_receivers_from_coefficients followed by a multiplication.
void write_block_pixels(const float* sums, const float* tint, const BlockPixels& pixels);

}  // namespace relume::view
