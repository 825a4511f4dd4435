#include "protocol/tripling/haar_tripling.h"

#include "protocol/tripling/wavelet_square.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace relume::tripling {
namespace {

// A basis function of a face. The scaling function has no type, and its square is the face.
struct HaarFunction {
    WaveletSquare square;
    WaveletType type = WaveletType::along_columns;
    bool is_scaling = false;
};

HaarFunction function_from_coefficient(std::uint32_t n, std::size_t coefficient) {
    const auto row = static_cast<std::uint32_t>(coefficient / n);
    const auto column = static_cast<std::uint32_t>(coefficient % n);
    if (coefficient == 0) {
        return {.square = {}, .type = {}, .is_scaling = true};
    }
    const auto level = static_cast<std::uint32_t>(std::bit_width(std::max(row, column))) - 1;
    const std::uint32_t side = 1U << level;
    const bool lower = row >= side;
    const bool right = column >= side;
    return {.square = {.level = level, .row = row % side, .column = column % side},
            .type = lower ? (right ? WaveletType::along_both : WaveletType::along_rows)
                          : WaveletType::along_columns,
            .is_scaling = false};
}

// Sign of a function in the quarter that holds a square of a finer level, 0 where they do not
// overlap.
int sign_over_finer_square(const HaarFunction& coarser, const WaveletSquare& finer) {
    const std::uint32_t finer_by = finer.level - coarser.square.level;
    if (finer.row >> finer_by != coarser.square.row ||
        finer.column >> finer_by != coarser.square.column) {
        return 0;
    }
    const std::uint32_t quadrant =
        2 * (finer.row >> (finer_by - 1) & 1U) + (finer.column >> (finer_by - 1) & 1U);
    return quadrant_sign(coarser.type, quadrant);
}

// Of a wavelet taken twice and any third function.
double pair_tripling(std::uint32_t n, const HaarFunction& pair, const HaarFunction& third) {
    if (third.is_scaling) {
        return amplitude(n, 0);
    }
    if (third.square.level >= pair.square.level) {
        return 0;
    }
    return sign_over_finer_square(third, pair.square) * amplitude(n, third.square.level);
}

}  // namespace

double haar_value(std::uint32_t n,
                  std::size_t coefficient,
                  std::uint32_t row,
                  std::uint32_t column) {
    const HaarFunction function = function_from_coefficient(n, coefficient);
    if (function.is_scaling) {
        return amplitude(n, 0);
    }
    const WaveletSquare texel{.level = level_count(n), .row = row, .column = column};
    return sign_over_finer_square(function, texel) * amplitude(n, function.square.level);
}

double haar_tripling(std::uint32_t n, std::size_t u, std::size_t v, std::size_t w) {
    const HaarFunction fu = function_from_coefficient(n, u);
    const HaarFunction fv = function_from_coefficient(n, v);
    const HaarFunction fw = function_from_coefficient(n, w);
    if (fu.is_scaling && fv.is_scaling && fw.is_scaling) {
        return amplitude(n, 0);
    }
    if (u == v && !fu.is_scaling) {
        return pair_tripling(n, fu, fw);
    }
    if (u == w && !fu.is_scaling) {
        return pair_tripling(n, fu, fv);
    }
    if (v == w && !fv.is_scaling) {
        return pair_tripling(n, fv, fu);
    }
    const bool no_scaling = !fu.is_scaling && !fv.is_scaling && !fw.is_scaling;
    const bool one_square = fu.square == fv.square && fu.square == fw.square;
    const bool three_types = fu.type != fv.type && fu.type != fw.type && fv.type != fw.type;
    return no_scaling && one_square && three_types ? amplitude(n, fu.square.level) : 0;
}

HaarTriplingCount haar_tripling_count(std::uint32_t n) {
    const std::uint64_t functions = std::uint64_t{n} * n;
    // Functions that overlap each wavelet of level ℓ from a coarser level: 3ℓ + 1.
    const std::uint64_t pairs = 3 * (1 - functions + functions * level_count(n));
    return {.case_1 = 1,
            .case_2 = 2 * (functions - 1),
            .case_3 = 3 * pairs,
            .unordered_case_3 = pairs};
}

}  // namespace relume::tripling
