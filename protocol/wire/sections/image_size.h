// How large the room's image is.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

// Where receivers are the pixels of one image, the room has that image's size and keeps it.
struct ImageSize {
    std::uint32_t width = 512;
    std::uint32_t height = 512;

    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

inline constexpr Range kImageSide{1, kMaxImageSide};

inline constexpr std::array kImageSizeFields{
    field::integer<&ImageSize::width>("width", kImageSide, "pixels in a row"),
    field::integer<&ImageSize::height>("height", kImageSide, "rows"),
};

inline constexpr Section<ImageSize> kImageSize{"image", Stage::view, "How large the image is",
                                               kImageSizeFields};

}  // namespace relume::wire
