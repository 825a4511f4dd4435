// Which wavelets of the light an image brings up to date, seen on the cubemap
// [Overbeck06T §5.2, fig. 5.3].
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::lab {

// Of every texel of a cubemap of resolution n, how many levels have a wavelet over it that is
// updated: `updated` of every Haar coefficient, [6n²]. A level counts once for all wavelets of
// one place and its scaling function.
[[nodiscard]] std::vector<std::uint8_t> covered_levels(std::uint32_t face_resolution,
                                                       const std::vector<bool>& updated);

// What a method covers in one image, and in the last kCoverageImages images up to it.
inline constexpr std::uint32_t kCoverageImages = 5;
struct Coverage {
    std::string method;
    std::uint32_t image = 0;
    std::vector<std::uint8_t> levels;      // [6n²]
    std::vector<std::uint8_t> cumulative;  // [6n²]
};

}  // namespace relume::lab
