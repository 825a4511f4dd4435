// Radiance HDR and OpenEXR files as environments, read through OpenImageIO in this process.
//
// Only for files the operator put there. What a stranger sends goes through
// sandboxed_decoder.h, which runs this code in a child.
#pragma once

#include "server/light/environment_map.h"
#include "server/light/projection.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::light {

struct ImportedEnvironment {
    EnvironmentMap map;
    // What was changed or ignored on the way, one sentence each: "12 negative texels set to 0".
    std::vector<std::string> warnings;
};

struct ImportedImage {
    MapImage image;
    Projection projection = Projection::lat_long;
    std::vector<std::string> warnings;
};

// The projection is detected by shape unless given. One channel is taken as grey, alpha is
// ignored, other layers of an EXR file are ignored with a warning. Negative texels become 0,
// NaN becomes the mean of its finite neighbours, +∞ the largest half float, each with a
// warning; a file where more than one texel in a hundred is not finite is refused. Throws
// EnvironmentError naming what was found and what was expected.
[[nodiscard]] ImportedEnvironment import_environment(const std::filesystem::path& file,
                                                     std::optional<Projection> projection = {});
[[nodiscard]] ImportedEnvironment import_environment(std::span<const std::byte> file_bytes,
                                                     std::optional<Projection> projection = {});

// The same up to the finished image, for who sends it elsewhere. Images with more texels than
// `max_texels` are refused before they are decoded.
[[nodiscard]] ImportedImage import_image(std::span<const std::byte> file_bytes,
                                         std::optional<Projection> projection = {},
                                         std::size_t max_texels = kMaxMapTexels);

}  // namespace relume::light
