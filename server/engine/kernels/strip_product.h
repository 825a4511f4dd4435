// The inner loop of whole products: strips of many columns at one place of a block, added up in
// registers.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// Strips of one block, ordered by their place in it and then by column. All are of the same few
// columns, whose weights fit into a near cache.
template <typename Value>
struct StripRun {
    const std::uint16_t* columns = nullptr;  // of every strip its column's place in the weights
    const Value* values = nullptr;           // [strips][8]
    // Strips at place s of the block are [begins[s], begins[s + 1]).
    std::span<const std::uint32_t, transport::kStripsPerBlock + 1> begins;
    float scale = 1;  // of all values
};

// Red, green and blue, and a zero, so that a column's weights lie in one cache line.
inline constexpr std::size_t kWeightsPerColumn = 4;

// One of those whose products are made together.
struct StripTarget {
    const float* weights = nullptr;  // [columns][4]
    float* sums = nullptr;           // of the block, [3][256]
};

// For every place s, slot i of it and colour c, adds scale·Σ weight(column,c)·value to the
// sums of every target. The order is part of the contract, so that every instruction set, and
// any company, gives the same bits: of the strips at a place those of even number and those of
// odd number (counted from the first there) are added up apart, each from zero and in order;
// then the two are added, and scale times that is added to the sum. Products are added without
// rounding in between (fused multiply-add).
template <typename Value>
using MultiplyStrips = void(const StripRun<Value>& run, std::span<const StripTarget> targets);

// The specification: one value at a time.
MultiplyStrips<std::int8_t> multiply_strips_scalar;
MultiplyStrips<float> multiply_float_strips_scalar;
// The best the processor has, or what RELUME_FORCE_TARGET names (kernels/target.h).
MultiplyStrips<std::int8_t> multiply_strips;
MultiplyStrips<float> multiply_float_strips;

}  // namespace relume::engine
