// The integral of a product of three functions on one face, from their Haar coefficients
// [Ng04 §5.1, §5.2], all coefficients counted. These are the specification of the algorithms
// that leave coefficients out.
//
// Each function is n² coefficients of one face in the order of haar.h, n any power of two. The
// result is Σ_texels L·V·ρ̃, so that the measure has to be in one of the three: here in ρ̃, whose
// texels are ∫_texel ρ·cos dω (README.md). Generic in the type of number: float, double, or one
// that counts its operations.
#pragma once

#include "protocol/tripling/wavelet_square.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace relume::tripling {

// Three functions, of which any may be light, visibility or material: the integral is
// symmetric.
template <typename Number>
struct FaceTriple {
    std::span<const Number> light;
    std::span<const Number> visibility;
    std::span<const Number> material;
};

// The same of n² texels instead of coefficients, in 3n² operations.
template <typename Number>
[[nodiscard]] Number pixel_triple_product(const FaceTriple<Number>& texels) {
    Number sum{};
    for (std::size_t i = 0; i < texels.light.size(); ++i) {
        sum = sum + texels.light[i] * texels.visibility[i] * texels.material[i];
    }
    return sum;
}

// The parts of a square that the algorithms share.

// The three coefficients of a square, in the order of kWaveletTypes.
template <typename Number>
std::array<Number, 3> square_coefficients(std::uint32_t n,
                                          const WaveletSquare& square,
                                          std::span<const Number> coefficients) {
    return {coefficients[coefficient_from_wavelet(n, square, WaveletType::along_columns)],
            coefficients[coefficient_from_wavelet(n, square, WaveletType::along_rows)],
            coefficients[coefficient_from_wavelet(n, square, WaveletType::along_both)]};
}

// Sums of what overlaps the four quarters of a square, in units of its amplitude: twice the
// averages that haar.h has one level further.
template <typename Number>
std::array<Number, 4> quarter_sums(const Number& average,
                                   const std::array<Number, 3>& wavelets) {
    const Number left = average + wavelets[0];
    const Number right = average - wavelets[0];
    const Number left_difference = wavelets[1] + wavelets[2];
    const Number right_difference = wavelets[1] - wavelets[2];
    return {left + left_difference, right + right_difference, left - left_difference,
            right - right_difference};
}

// What one square adds to the integral, over its amplitude: case 2 of the theorem, and case 3
// with the pair in this square. `averages` are the parent sums over the amplitude. With w the
// product of V and ρ̃ as far as it lies in the square,
//     Σ_M L_M·w_M + L·⟨V, ρ̃⟩.
template <typename Number>
Number square_term(const std::array<Number, 3>& averages,  // of L, V, ρ̃
                   const std::array<Number, 3>& light,
                   const std::array<Number, 3>& visibility,
                   const std::array<Number, 3>& material) {
    Number sum = averages[0] * (visibility[0] * material[0] + visibility[1] * material[1] +
                                visibility[2] * material[2]);
    for (std::size_t m = 0; m < 3; ++m) {
        const std::size_t next = (m + 1) % 3;
        const std::size_t last = (m + 2) % 3;
        sum = sum + light[m] *
                        (averages[1] * material[m] + averages[2] * visibility[m] +
                         visibility[next] * material[last] + visibility[last] * material[next]);
    }
    return sum;
}

// The parent sum of a function at a square, over the square's amplitude 2^level/n: the value
// over the square of all basis functions of coarser levels. Climbs to the root.
template <typename Number>
[[nodiscard]] Number parent_sum(std::uint32_t n,
                                WaveletSquare square,
                                std::span<const Number> coefficients) {
    Number scale = Number(1.0);
    Number sum{};
    while (square.level > 0) {
        const std::uint32_t quadrant = 2 * (square.row % 2) + square.column % 2;
        square = {square.level - 1, square.row / 2, square.column / 2};
        scale = scale * Number(0.5);
        const auto wavelets = square_coefficients(n, square, coefficients);
        for (std::size_t m = 0; m < 3; ++m) {
            const Number part = scale * wavelets[m];
            sum = kQuadrantSigns[quadrant][m] > 0 ? sum + part : sum - part;
        }
    }
    return sum + scale * coefficients[0];
}

// In O(N log N): every square finds its parent sums by itself [Ng04 §5.1].
template <typename Number>
[[nodiscard]] Number log_linear_triple_integral(std::uint32_t n,
                                                const FaceTriple<Number>& face) {
    Number sum =
        Number(amplitude(n, 0)) * face.light[0] * face.visibility[0] * face.material[0];
    for (std::size_t index = 0; index < square_count(n); ++index) {
        const WaveletSquare square = square_from_index(index);
        const std::array<Number, 3> averages{parent_sum(n, square, face.light),
                                             parent_sum(n, square, face.visibility),
                                             parent_sum(n, square, face.material)};
        sum = sum + Number(amplitude(n, square.level)) *
                        square_term(averages, square_coefficients(n, square, face.light),
                                    square_coefficients(n, square, face.visibility),
                                    square_coefficients(n, square, face.material));
    }
    return sum;
}

// In O(N): a square hands its parent sums down [Ng04 §5.2].
//
// A square takes 34 multiplications and additions, 3 more to halve what it inherits unless it
// is the root, and 24 to hand it down unless it is of the finest level; a level takes 2 and the
// scaling functions 3. That is 43/3·N and some constants. [Ng04 §5.2] estimates 13 N for the
// same algorithm, with case 3 at half the squares; written as it is there, with case 3
// everywhere, it takes 18 N.
template <typename Number>
[[nodiscard]] Number linear_triple_integral(std::uint32_t n, const FaceTriple<Number>& face) {
    const std::array functions{face.light, face.visibility, face.material};
    // Of the squares of one level, in the order of their indices: sums over the amplitude of
    // the parents, that of the root over its own.
    std::vector<std::array<Number, 3>> inherited{
        {face.light[0], face.visibility[0], face.material[0]}};
    Number sum =
        Number(amplitude(n, 0)) * face.light[0] * face.visibility[0] * face.material[0];
    for (std::uint32_t level = 0; level < level_count(n); ++level) {
        const bool is_finest = level + 1 == level_count(n);
        std::vector<std::array<Number, 3>> handed_down(is_finest ? 0 : 4 * inherited.size());
        Number level_sum{};
        for (std::size_t i = 0; i < inherited.size(); ++i) {
            const WaveletSquare square = square_from_index(first_square(level) + i);
            std::array<Number, 3> averages = inherited[i];
            std::array<std::array<Number, 3>, 3> wavelets{};
            for (std::size_t f = 0; f < 3; ++f) {
                if (level > 0) {
                    averages[f] = averages[f] * Number(0.5);
                }
                wavelets[f] = square_coefficients(n, square, functions[f]);
                if (!is_finest) {
                    const auto quarters = quarter_sums(averages[f], wavelets[f]);
                    for (std::size_t quadrant = 0; quadrant < 4; ++quadrant) {
                        handed_down[4 * i + quadrant][f] = quarters[quadrant];
                    }
                }
            }
            level_sum =
                level_sum + square_term(averages, wavelets[0], wavelets[1], wavelets[2]);
        }
        sum = sum + Number(amplitude(n, level)) * level_sum;
        inherited = std::move(handed_down);
    }
    return sum;
}

}  // namespace relume::tripling
