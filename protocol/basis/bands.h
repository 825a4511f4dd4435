// The bands of a basis: which coefficient belongs to which, and how fine each of them is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::basis {

// Of any basis. A set of bands is a mask of 32 bits.
inline constexpr std::uint32_t kMaxBands = 20;

// All that the engine's choosing needs to know of a basis.
struct Bands {
    std::vector<std::uint8_t> of_coefficient;  // [N], each below octaves.size()
    // log₂ of each band's frequency relative to that of band 0, [bands]. What falls off as a
    // power of frequency falls off exponentially with the octave.
    std::vector<float> octaves;

    [[nodiscard]] std::size_t coefficient_count() const { return of_coefficient.size(); }
    [[nodiscard]] std::uint32_t band_count() const {
        return static_cast<std::uint32_t>(octaves.size());
    }
};

}  // namespace relume::basis
