// Image files made in memory.
#pragma once

#include "protocol/light/environment_map.h"

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace relume::light::testing {

// `format` is OpenImageIO's name, "openexr" or "hdr"; `adjust` may change what is written about
// the image. `values` are interleaved, as many as the image's channels ask for.
std::vector<std::byte> encode(
    const std::string& format,
    int width,
    int height,
    const std::vector<std::string>& channels,
    const std::vector<float>& values,
    const std::function<void(OIIO::ImageSpec&)>& adjust = [](OIIO::ImageSpec&) {});

std::vector<std::byte> encode_rgb(const std::string& format, const MapImage& image);

}  // namespace relume::light::testing
