// The squares that the Haar wavelets of a face live in [Ng04 §4.5.1], and where haar.h keeps
// their coefficients.
//
// At level ℓ (0 is the coarsest) a face of n×n texels, n any power of two, has 4^ℓ squares of
// n/2^ℓ texels a side. Three wavelets live in each; with the scaling function they are n²
// functions. Squares are counted as a heap counts its nodes: from the coarsest level on, within
// a level by interleaved bits of row and column, so that the children of square i are 4i+1 …
// 4i+4.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace relume::tripling {

struct WaveletSquare {
    std::uint32_t level = 0;
    std::uint32_t row = 0;     // in [0, 2^level)
    std::uint32_t column = 0;  // in [0, 2^level)

    friend bool operator==(const WaveletSquare&, const WaveletSquare&) = default;
};

// What a wavelet is the difference of: left and right half, upper and lower half, or the two
// diagonals of its square. [Ng04] writes 01, 10 and 11.
enum class WaveletType : std::uint8_t { along_columns, along_rows, along_both };

inline constexpr std::array kWaveletTypes{WaveletType::along_columns, WaveletType::along_rows,
                                          WaveletType::along_both};

// Levels of a face: log2 n.
[[nodiscard]] constexpr std::uint32_t level_count(std::uint32_t n) {
    return static_cast<std::uint32_t>(std::countr_zero(n));
}
// Squares of a face: (n² − 1)/3.
[[nodiscard]] constexpr std::size_t square_count(std::uint32_t n) {
    return (std::size_t{n} * n - 1) / 3;
}
// Squares of all levels coarser than `level`, which is the index of its first one.
[[nodiscard]] constexpr std::size_t first_square(std::uint32_t level) {
    return ((std::size_t{1} << (2 * level)) - 1) / 3;
}
[[nodiscard]] constexpr std::uint32_t level_from_square(std::size_t index) {
    return (static_cast<std::uint32_t>(std::bit_width(3 * index + 1)) - 1) / 2;
}
[[nodiscard]] constexpr std::size_t first_child(std::size_t index) {
    return 4 * index + 1;
}
// Of a square that is not the coarsest one.
[[nodiscard]] constexpr std::size_t parent_square(std::size_t index) {
    return (index - 1) / 4;
}
// Which quarter of its parent a square is: 2·(lower half) + (right half).
[[nodiscard]] constexpr std::uint32_t quadrant_in_parent(std::size_t index) {
    return static_cast<std::uint32_t>((index - 1) % 4);
}

[[nodiscard]] std::size_t index_from_square(const WaveletSquare& square);
[[nodiscard]] WaveletSquare square_from_index(std::size_t index);

// Index within the face, in the order of haar.h. The scaling coefficient is at 0.
[[nodiscard]] std::size_t coefficient_from_wavelet(std::uint32_t n,
                                                   const WaveletSquare& square,
                                                   WaveletType type);

// +1 or −1: the sign of a wavelet in a quarter of its square, [quadrant][type].
inline constexpr std::array<std::array<int, 3>, 4> kQuadrantSigns{
    {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};

[[nodiscard]] constexpr int quadrant_sign(WaveletType type, std::uint32_t quadrant) {
    return kQuadrantSigns[quadrant][static_cast<std::size_t>(type)];
}

// The absolute value, wherever it is not zero, of a basis function of a level; the scaling
// function counts to level 0. Functions are orthonormal over texels: 2^level/n.
[[nodiscard]] constexpr double amplitude(std::uint32_t n, std::uint32_t level) {
    return static_cast<double>(std::uint32_t{1} << level) / static_cast<double>(n);
}

}  // namespace relume::tripling
