// What many points see of a cubemap, as Haar wavelets of open and closed texels: exact, without
// zeros, and each coefficient found in constant time.
//
// The coefficient of a wavelet whose square is w texels wide is d/w, with d the difference of
// two numbers of open texels. It takes 8 bits up to w = 8, where nearly all of them are, and 16
// bits above. (With n = 256 the coarsest ones are rounded to even d, which is 2⁻¹⁵ of the
// face.)
#pragma once

#include "protocol/tripling/sparse_wavelets.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace relume::tripling {

// Squares of at most 8 texels a side have coefficients of 8 bits: levels from this one on.
[[nodiscard]] constexpr std::uint32_t first_narrow_level(std::uint32_t n) {
    return level_count(n) > 3 ? level_count(n) - 3 : 0;
}

// The face of a cubemap that a point sees.
struct VisibleFace {
    float scaling = 0;             // coefficient of the scaling function
    std::uint32_t first_byte = 0;  // of the face's values within the point's
    std::uint32_t wide_count = 0;  // squares of 16 bits; they come first
};

// One point of a VisibilityWavelets, which it refers to.
struct VisibilityView {
    const std::uint64_t* words = nullptr;  // [word_count(n)], a bit a square that has values
    const std::uint16_t* ranks = nullptr;  // [word_count(n)], squares before it in its face
    const VisibleFace* faces = nullptr;    // [6]
    const std::byte* values = nullptr;     // three a square, in the order of squares
};

// Immutable once all points are in; then safe to share between threads.
class VisibilityWavelets {
  public:
    // Of cubemaps of resolution n, a power of two from 1 to 256.
    explicit VisibilityWavelets(std::uint32_t n);

    // A bit a texel in the order of cubemap.h, the lowest bit of the first word first; 1 is
    // open. ⌈6·n²/64⌉ words.
    void append(std::span<const std::uint64_t> open_texels);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t point_count() const { return first_value_.size(); }
    [[nodiscard]] VisibilityView point(std::size_t point) const;
    [[nodiscard]] SparseWavelets sparse(std::size_t point) const;

    // Coefficients of wavelets that are not zero, of all points, and bytes that hold all of it.
    [[nodiscard]] std::size_t nonzero_count() const { return nonzero_count_; }
    [[nodiscard]] std::size_t byte_count() const;

  private:
    std::uint32_t n_;
    std::size_t nonzero_count_ = 0;
    std::vector<std::uint64_t> words_;
    std::vector<std::uint16_t> ranks_;
    std::vector<VisibleFace> faces_;
    std::vector<std::size_t> first_value_;  // of each point
    std::vector<std::byte> values_;
};

// What a stored value of a level stands for: 1/w, or twice that where d needs 17 bits.
[[nodiscard]] constexpr float visibility_step(std::uint32_t n, std::uint32_t level) {
    const float step = static_cast<float>(std::uint32_t{1} << level) / static_cast<float>(n);
    return n >> level == 256 ? 2 * step : step;
}

// Writes the three coefficients of the square of index `within` of a face; false, and nothing
// written, where the point has no such square. One bit, one popcount, three values.
inline bool read_visible_square(std::uint32_t n,
                                const VisibilityView& point,
                                std::size_t face,
                                std::size_t within,
                                float* coefficients) {
    const std::size_t square = face * face_stride(n) + within;
    const std::uint64_t word = point.words[square / kWordBits];
    const std::size_t bit = square % kWordBits;
    if ((word >> bit & 1U) == 0) {
        return false;
    }
    const std::uint64_t before = word & ((std::uint64_t{1} << bit) - 1);
    const std::size_t rank =
        point.ranks[square / kWordBits] + static_cast<std::size_t>(std::popcount(before));
    const VisibleFace& visible = point.faces[face];
    const float step = visibility_step(n, level_from_square(within));
    const std::byte* values = point.values + visible.first_byte;
    const auto write = [&](const auto& stored) {
        for (std::size_t m = 0; m < stored.size(); ++m) {
            coefficients[m] = step * static_cast<float>(stored[m]);
        }
    };
    if (rank < visible.wide_count) {
        std::array<std::int16_t, 3> wide{};
        std::memcpy(wide.data(), values + 6 * rank, sizeof(wide));
        write(wide);
    } else {
        std::array<std::int8_t, 3> narrow{};
        std::memcpy(narrow.data(), values + 3 * (rank + visible.wide_count), sizeof(narrow));
        write(narrow);
    }
    return true;
}

}  // namespace relume::tripling
