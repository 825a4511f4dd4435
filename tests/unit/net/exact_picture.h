// What a relighter shows at rest, to the last bit.
#pragma once

#include "server/net/rooms/relighter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace relume::net {

// All bits of the half image; expects that it is exact, and that it says so.
[[nodiscard]] inline std::vector<std::uint16_t> exact_picture(Relighter& relighter) {
    const Picture picture = relighter.picture({}, {.displays = {}, .half_planes = true}, 0);
    EXPECT_TRUE(picture.header.exact);
    EXPECT_EQ(picture.header.relative_error, 0);
    EXPECT_EQ(picture.header.coefficients_remaining, 0U);
    std::vector<std::uint16_t> bits;
    for (const auto value : picture.composer->half_image().values) {
        bits.push_back(value.bits());
    }
    return bits;
}

}  // namespace relume::net
