// How far an image is from its reference.
#pragma once

#include <cstdint>
#include <span>

namespace relume::lab {

// Interleaved RGB images of 3·width·height values.
struct ImageError {
    double l2 = 0;  // ‖a − b‖ / ‖b‖
    double h1 =
        0;  // the same of values and forward differences, the Sobolev norm [Ng03 §4.1.2]
    double peak = 0;  // max |a − b| / RMS of b
};

[[nodiscard]] ImageError image_error(std::span<const float> image,
                                     std::span<const float> reference,
                                     std::uint32_t width);

}  // namespace relume::lab
