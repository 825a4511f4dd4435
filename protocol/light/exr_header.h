// What an OpenEXR file says of itself, walked by hand so that every size in it is bounded by
// the file before a library allocates by it. Internal to protocol/light. Layout: "OpenEXR File
// Layout".
#pragma once

#include "protocol/light/image_file.h"

#include <Imath/ImathBox.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::light {

struct ExrChannel {
    std::string name;
    std::int32_t x_sampling = 1;
    std::int32_t y_sampling = 1;
    std::size_t bytes = 4;  // of a sample
};

struct ExrPart {
    std::string name;  // empty in files of one part
    std::string type;  // "scanlineimage", "tiledimage", …
    std::vector<ExrChannel> channels;
    Imath::Box2i data_window;
    Imath::Box2i display_window;
    std::optional<Primaries> primaries;
    int orientation = 1;  // Exif's code
    std::uint8_t compression = 0;
    std::size_t chunk_count = 0;

    [[nodiscard]] bool is_deep() const { return type.starts_with("deep"); }
};

// Throws EnvironmentError when a size passes the file or the bounds, or the file is cut: every
// chunk that the tables of the parts name must lie in it.
[[nodiscard]] std::vector<ExrPart> walk_exr(std::span<const std::byte> bytes,
                                            const ImageBounds& bounds);
// The same of headers alone; `bytes` may be the file's beginning.
[[nodiscard]] std::vector<ExrPart> walk_exr_headers(std::span<const std::byte> bytes,
                                                    const ImageBounds& bounds);

// Of a window, both ends included.
[[nodiscard]] std::size_t width_of(const Imath::Box2i& window);
[[nodiscard]] std::size_t height_of(const Imath::Box2i& window);

}  // namespace relume::light
