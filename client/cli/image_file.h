// Received images as files: linear EXR and Radiance HDR, display-referred PNG and JPEG.
#pragma once

#include "protocol/wire/half_image.h"
#include "protocol/wire/image_header.h"
#include "protocol/wire/room_state.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace relume::cli {

enum class ImageFormat { exr, hdr, png, jpeg };

// From the extension. Throws ClientError for any but .exr, .hdr, .png, .jpg, .jpeg.
[[nodiscard]] ImageFormat image_format_from_path(const std::filesystem::path& path);

// Writes the file whole or not at all; the format is that of the extension. EXR holds the
// half floats as they are (R, G, B and, where the image has it, A; premultiplied) and, as
// attributes "relume:…", what the header states; HDR the same colours. PNG and JPEG hold them
// after `display`; PNG keeps alpha (not premultiplied), JPEG stands over black. Throws
// ClientError.
void write_image_file(const std::filesystem::path& path,
                      const wire::HalfImage& image,
                      const wire::ImageHeader& header,
                      const wire::Display& display);

// The bytes of a JPEG image, into a .jpg as they are or decoded into a .png.
void write_image_file(const std::filesystem::path& path,
                      std::span<const std::byte> jpeg,
                      const wire::ImageHeader& header);

// Throws ClientError where it is known already that `path` cannot be written: no such folder,
// no permission, no room, a folder of that name.
void require_writable(const std::filesystem::path& path);

// Writes text or bytes to `path` by way of a temporary file beside it, synced, and renamed.
void write_file(const std::filesystem::path& path, std::span<const std::byte> content);
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace relume::cli
