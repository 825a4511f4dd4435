// How much of an image a viewer would tell from its reference.
#pragma once

#include <cstdint>
#include <span>

namespace relume::lab {

// Part of the pixels, 0 to 1, that fail Yee's perceptual metric [Yee01] as OpenImageIO has it
// (ImageBufAlgo::compare_Yee): contrast sensitivity, visual masking and colour, on a display
// whose white has 100 cd/m², the image 45 degrees wide. It is given display-linear values: both
// images tone-mapped as the server's images are (protocol/README.md §3.2), exposed so that the
// reference's mean luminance is 0.18. Interleaved RGB, 3·width·height values each, height from
// the span. Independent of the number of threads.
[[nodiscard]] double visible_part(std::span<const float> image,
                                  std::span<const float> reference,
                                  std::uint32_t width);

}  // namespace relume::lab
