// Sets of bands, or of blocks of a run, as bits.
#pragma once

#include <bit>
#include <cstdint>

namespace relume::engine {

[[nodiscard]] constexpr std::uint32_t band_bit(std::uint32_t band) {
    return std::uint32_t{1} << band;
}

[[nodiscard]] constexpr bool has_band(std::uint32_t bands, std::uint32_t band) {
    return (bands & band_bit(band)) != 0;
}

// Calls visit(number) for each bit that is set, in ascending order.
template <typename Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
}

}  // namespace relume::engine
