// Radiance HDR and OpenEXR files as environments, read in this process.
//
// Only for files the operator put there. What a stranger sends goes through
// sandboxed_decoder.h, which runs this code in a child.
#pragma once

#include "protocol/light/environment_map.h"
#include "protocol/light/map_centre.h"
#include "protocol/light/projection.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::light {

struct ImportOptions {
    std::optional<Projection> projection = {};  // none: by shape
    MapCentre centre = MapCentre::negative_z;
    // Of an EXR file, as ImportNotes::layers names it; empty: the beauty.
    std::string layer = {};
    std::size_t max_texels = kMaxMapTexels;
};

// What there is to say of a file beside its texels.
struct ImportNotes {
    std::string layer;                // used; empty for channels without a name
    std::vector<std::string> layers;  // of an EXR file: all that hold colours
    // What was changed or ignored on the way, one sentence each: "12 negative texels set to 0".
    std::vector<std::string> warnings;
};

struct ImportedEnvironment {
    EnvironmentMap map;
    ImportNotes notes;
};

struct ImportedImage {
    MapImage image;
    Projection projection = Projection::lat_long;
    ImportNotes notes;
};

// Colours become linear Rec. 709, by protocol/light.md §1. Other primaries are converted,
// stated exposures divided out, windows of EXR files framed, negative texels become 0, NaN the
// mean of its finite neighbours, +∞ the largest half float, each with a warning; a file where
// more than one texel in a hundred is not finite is refused. A square image, taken for an
// angular map without being told, is a warning. Throws EnvironmentError naming what was found
// and what was expected.
[[nodiscard]] ImportedEnvironment import_environment(const std::filesystem::path& file,
                                                     const ImportOptions& options = {});
[[nodiscard]] ImportedEnvironment import_environment(std::span<const std::byte> file_bytes,
                                                     const ImportOptions& options = {});

// The same up to the finished image, for who sends it elsewhere. Images with more texels than
// `max_texels` are refused before they are decoded. The centre is left to the map.
[[nodiscard]] ImportedImage import_image(std::span<const std::byte> file_bytes,
                                         const ImportOptions& options = {});

// A file's size and what it will be taken for, from its header alone. Throws EnvironmentError.
struct EnvironmentHeader {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Projection projection = Projection::lat_long;
};
[[nodiscard]] EnvironmentHeader read_environment_header(const std::filesystem::path& file,
                                                        const ImportOptions& options = {});

}  // namespace relume::light
