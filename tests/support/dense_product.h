// T·L, straight from the contract (protocol/README.md §2) and in double precision: every column
// of the stored transport times its lighting coefficient.
#pragma once

#include "protocol/transport/transport.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::test {

struct LinearImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Imath::V3d> pixels;  // row-major from the top left, linear
};

// `light`: radiance of the 6·n² texels, n the transport's.
[[nodiscard]] LinearImage dense_product(const transport::Transport& transport,
                                        const std::vector<Imath::V3f>& light);

}  // namespace relume::test
