// A small picture of an environment for lists.
#pragma once

#include "protocol/light/environment_map.h"

#include <cstdint>
#include <vector>

namespace relume::light {

struct PreviewImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgb;  // sRGB, interleaved, row-major from the top left
};

// Lat-long whatever the source's projection, exposed by its log-average luminance, with the
// filmic curve of protocol/README.md §3.2.
[[nodiscard]] PreviewImage make_preview(const EnvironmentMap& map,
                                        std::uint32_t width = 256,
                                        std::uint32_t height = 128);

}  // namespace relume::light
