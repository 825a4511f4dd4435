// What kind of file bytes are, by how they begin. Internal to protocol/light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::light {

enum class ImageFormat : std::uint8_t { radiance_hdr, openexr };

// Throws EnvironmentError that names what the bytes are instead, where that is known: "a PNG".
[[nodiscard]] ImageFormat require_image_format(std::span<const std::byte> bytes);

}  // namespace relume::light
