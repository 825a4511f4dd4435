// What a file says of its picture, before anything is mended. Internal to protocol/light.
#pragma once

#include "protocol/light/colour_primaries.h"
#include "protocol/light/environment_map.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::light {

struct ImageFile {
    MapImage image;       // upright; values as the file has them but for its exposures
    bool is_xyz = false;  // CIE XYZ instead of colours of `primaries`
    Primaries primaries;  // Rec. 709 when the file states none that can be used
    std::string layer;    // used; empty: what has no name
    std::vector<std::string> layers;  // all that hold colours, in the order of the file
    std::vector<std::string> warnings;
};

struct ImageBounds {
    std::size_t max_texels = kMaxMapTexels;
    // Of what is held beside the texels while one piece of the file is expanded.
    std::size_t max_block_bytes = std::size_t{512} << 20;
};

// Throws EnvironmentError: "what is found, expected expected".
[[noreturn]] void refuse_image(std::string_view what, std::string found, std::string expected);
// "image ends …; the file is incomplete: copy it again".
[[noreturn]] void refuse_incomplete(std::string where);

// Throws EnvironmentError unless an image may have this many texels.
void check_size(std::size_t width, std::size_t height, const ImageBounds& bounds);

// Radiance HDR [Ward91]: RGBE and XYZE, flat or run-length encoded in the new or the old way,
// any of the eight orders of texels. EXPOSURE and COLORCORR are divided out, with a warning.
// Memory grows with what has been read, so a short file cannot claim much.
[[nodiscard]] ImageFile read_radiance_hdr(std::span<const std::byte> bytes,
                                          const ImageBounds& bounds);

// OpenEXR, its header walked by exr_header.h before the library sees it. `layer` names the
// layer as `layers` does; empty: the beauty (exr_layers.h). What lies outside the display
// window is left out, what the data window does not hold is black.
[[nodiscard]] ImageFile read_exr(std::span<const std::byte> bytes,
                                 const std::string& layer,
                                 const ImageBounds& bounds);

// Size alone, for lists: as the readers above would give it, without decoding.
struct ImageSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};
[[nodiscard]] ImageSize radiance_hdr_size(std::span<const std::byte> bytes);
[[nodiscard]] ImageSize exr_size(std::span<const std::byte> bytes, const std::string& layer);

}  // namespace relume::light
