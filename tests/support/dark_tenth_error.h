// Rounding shows where the image is dark.
#pragma once

#include "protocol/transport/transport.h"

#include <span>
#include <vector>

namespace relume::test {

// Relative L2 error of the image, tint applied, over the tenth of its covered pixels in which
// it is darkest. Both arguments are sums in the basis of the blocks, [blocks][3][256].
[[nodiscard]] double dark_tenth_error(const transport::Transport& transport,
                                      std::span<const float> shown_sums,
                                      std::vector<double> exact_sums);

}  // namespace relume::test
