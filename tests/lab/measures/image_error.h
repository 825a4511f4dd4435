// How far an image is from its reference.
#pragma once

#include <cstdint>
#include <span>

namespace relume::lab {

// Relative to the reference; 0 where both are black, 1 where only the reference is.
struct ImageError {
    double l2 = 0;    // ‖a − b‖ / ‖b‖
    double h1 = 0;    // the same of values and forward differences, Sobolev [Ng03 §4.1.2]
    double peak = 0;  // max |a − b| / RMS of b
};

// Interleaved RGB images of 3·width·height values.
[[nodiscard]] ImageError image_error(std::span<const float> image,
                                     std::span<const float> reference,
                                     std::uint32_t width);

// Flicker: ‖e − e'‖ / ‖b‖, e = a − b the error of an image and e' that of the image before it.
// Its square is the relative energy of what changed without reason: 0 where the error stands
// still on the screen, however large. `previous_error` becomes e.
[[nodiscard]] double error_change(std::span<const float> image,
                                  std::span<const float> reference,
                                  std::span<float> previous_error);

}  // namespace relume::lab
