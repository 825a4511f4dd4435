// Which images of a room a viewer asks for.
#pragma once

#include "protocol/base/text/name_table.h"

#include <cstdint>

namespace relume::net {

enum class ImageInterest : std::uint8_t {
    all,           // JPEG while the image changes, half floats when it rests
    settled,       // only those of half floats when it rests
    moving_float,  // half floats always
};

inline constexpr text::NameTable<ImageInterest, 3> kImageInterestNames({{
    {ImageInterest::all, "all"},
    {ImageInterest::settled, "settled"},
    {ImageInterest::moving_float, "moving-float"},
}});

}  // namespace relume::net
