// The 64 bytes before every image (protocol/README.md §3.2), little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::wire {

inline constexpr std::size_t kImageHeaderBytes = 64;
inline constexpr std::uint16_t kImageHeaderVersion = 1;

enum class ImageEncoding : std::uint16_t { jpeg = 1, half_planes = 2 };

struct ImageHeader {
    ImageEncoding encoding = ImageEncoding::jpeg;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint64_t revision = 0;  // every edit up to this one is in the image
    std::uint64_t sequence = 0;  // per room, ascending
    float relative_error = 0;    // stated relative L2; 0 when exact
    bool exact = false;
    bool has_alpha = false;      // four half planes instead of three
    float edit_to_image_ms = 0;  // from taking the edit to the finished relit image
    float relight_ms = 0;
    float encode_ms = 0;
    std::uint32_t coefficients_applied = 0;
    std::uint32_t payload_bytes = 0;
    std::uint32_t coefficients_remaining = 0;  // 0 when exact

    friend bool operator==(const ImageHeader&, const ImageHeader&) = default;
};

// Throws WireError{bad_image} naming the field for a header that decoding would refuse, but
// for the payload, which is not there yet.
[[nodiscard]] std::array<std::byte, kImageHeaderBytes> encode_image_header(
    const ImageHeader& header);

// `frame` is the whole binary frame, header and payload; the payload is what follows the first
// 64 bytes, and its length is checked. Throws WireError{bad_image}; the error's path is the
// name of the offending field as in §3.2: "frame" (shorter than a header), "magic", "version",
// "encoding", "width", "height", "revision", "sequence", "relative_error", "flags",
// "edit_to_image_ms", "relight_ms", "encode_ms", "payload_bytes", "coefficients_remaining".
[[nodiscard]] ImageHeader decode_image_header(std::span<const std::byte> frame);

}  // namespace relume::wire
