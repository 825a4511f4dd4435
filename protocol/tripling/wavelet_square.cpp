#include "protocol/tripling/wavelet_square.h"

namespace relume::tripling {

std::size_t index_from_square(const WaveletSquare& square) {
    std::size_t interleaved = 0;
    for (std::uint32_t bit = 0; bit < square.level; ++bit) {
        interleaved |= std::size_t{square.column >> bit & 1U} << (2 * bit);
        interleaved |= std::size_t{square.row >> bit & 1U} << (2 * bit + 1);
    }
    return first_square(square.level) + interleaved;
}

WaveletSquare square_from_index(std::size_t index) {
    WaveletSquare square{.level = level_from_square(index), .row = 0, .column = 0};
    const std::size_t interleaved = index - first_square(square.level);
    for (std::uint32_t bit = 0; bit < square.level; ++bit) {
        square.column |= static_cast<std::uint32_t>(interleaved >> (2 * bit) & 1U) << bit;
        square.row |= static_cast<std::uint32_t>(interleaved >> (2 * bit + 1) & 1U) << bit;
    }
    return square;
}

std::size_t coefficient_from_wavelet(std::uint32_t n,
                                     const WaveletSquare& square,
                                     WaveletType type) {
    const std::uint32_t side = 1U << square.level;
    const std::uint32_t row = square.row + (type == WaveletType::along_columns ? 0 : side);
    const std::uint32_t column = square.column + (type == WaveletType::along_rows ? 0 : side);
    return std::size_t{row} * n + column;
}

}  // namespace relume::tripling
