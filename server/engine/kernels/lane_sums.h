// Sixteen sums that go side by side, so that they are the same on every instruction set.
#pragma once

#include <array>
#include <cstddef>

namespace relume::engine {

inline constexpr std::size_t kLaneSums = 16;

// 0…7 to 8…15, 0…3 to 4…7, and so on. Changes the sums.
[[nodiscard]] inline float sum_in_halves(std::array<float, kLaneSums>& sums) {
    for (std::size_t half = kLaneSums / 2; half > 0; half /= 2) {
        for (std::size_t i = 0; i < half; ++i) {
            sums[i] += sums[i + half];
        }
    }
    return sums[0];
}

}  // namespace relume::engine
