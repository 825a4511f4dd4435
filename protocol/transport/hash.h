// A bijective mixer of 64 bits (SplitMix64's finaliser [Steele14]): reproducible noise without
// state, the same on every machine and thread.
#pragma once

#include <cstdint>

namespace relume::transport {

[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

// Uniform in [0, 1), from the top 24 bits.
[[nodiscard]] constexpr float unit_float(std::uint64_t bits) {
    return static_cast<float>(bits >> 40) * 0x1p-24F;
}

}  // namespace relume::transport
