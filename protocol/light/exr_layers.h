// Which of an OpenEXR file's channels are the picture. Internal to protocol/light.
#pragma once

#include "protocol/light/exr_header.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace relume::light {

struct ExrLayer {
    enum class Kind : std::uint8_t { rgb, grey, luminance_chroma };

    // "PART.LAYER", as much of it as the file has; printable ASCII. Empty for channels without
    // any prefix in a file of one part.
    std::string label;
    std::size_t part = 0;
    Kind kind = Kind::rgb;
    std::array<std::string, 3> channels;  // as the file names them: R, G, B; grey three times
};

// Those that hold colours, in the order of the file.
[[nodiscard]] std::vector<ExrLayer> colour_layers(std::span<const ExrPart> parts);

// The layer of that label; for an empty label the beauty: channels without prefix, or the layer
// that renderers name so ("Combined", "beauty", "rgba", …), in the first part that has one; or
// else the only layer whose name is not that of depth, normals, albedo, occlusion, masks or the
// like. Adds a warning where the choice is not plain. Throws EnvironmentError that lists the
// layers found.
[[nodiscard]] ExrLayer choose_layer(std::span<const ExrPart> parts,
                                    const std::string& label,
                                    std::vector<std::string>& warnings);

}  // namespace relume::light
