// How different an image looks from its reference.
#pragma once

#include <span>
#include <vector>

namespace relume::lab {

// Mean over the pixels of ΔE*ab [CIE15], the distance in CIELAB: about 2.3 is just
// noticeable [Mahy94]. Both images are shown as the server's images are (protocol/README.md
// §3.2), with the exposure of display_exposure.h for the reference; white is D65. Interleaved
// RGB of Rec. 709 primaries, 3·width·height values each.
[[nodiscard]] double mean_delta_e(std::span<const float> image,
                                  std::span<const float> reference);
// The same of every pixel.
[[nodiscard]] std::vector<double> pixel_delta_e(std::span<const float> image,
                                                std::span<const float> reference);

}  // namespace relume::lab
