#include "protocol/wire/image_header.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/limits.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace relume::wire {
namespace {

constexpr std::uint32_t kMagic = 0x494D4C52;  // "RLMI" read as a little-endian number
constexpr std::uint32_t kExactFlag = 1U << 0U;
constexpr std::uint32_t kAlphaFlag = 1U << 1U;

// Offsets of the fields.
constexpr std::size_t kAtMagic = 0;
constexpr std::size_t kAtVersion = 4;
constexpr std::size_t kAtEncoding = 6;
constexpr std::size_t kAtWidth = 8;
constexpr std::size_t kAtHeight = 12;
constexpr std::size_t kAtRevision = 16;
constexpr std::size_t kAtSequence = 24;
constexpr std::size_t kAtError = 32;
constexpr std::size_t kAtFlags = 36;
constexpr std::size_t kAtEditToImage = 40;
constexpr std::size_t kAtRelight = 44;
constexpr std::size_t kAtEncode = 48;
constexpr std::size_t kAtApplied = 52;
constexpr std::size_t kAtPayload = 56;
constexpr std::size_t kAtRemaining = 60;

template <typename Unsigned>
void store(std::span<std::byte> bytes, std::size_t offset, Unsigned value) {
    static_assert(std::is_unsigned_v<Unsigned>);
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
        bytes[offset + i] = static_cast<std::byte>((std::uint64_t{value} >> (8 * i)) & 0xFFU);
    }
}

template <typename Unsigned>
Unsigned load(std::span<const std::byte> bytes, std::size_t offset) {
    static_assert(std::is_unsigned_v<Unsigned>);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
        value |= std::to_integer<std::uint64_t>(bytes[offset + i]) << (8 * i);
    }
    return static_cast<Unsigned>(value);
}

void store(std::span<std::byte> bytes, std::size_t offset, float value) {
    store(bytes, offset, std::bit_cast<std::uint32_t>(value));
}

float load_float(std::span<const std::byte> bytes, std::size_t offset) {
    return std::bit_cast<float>(load<std::uint32_t>(bytes, offset));
}

[[noreturn]] void refuse(const char* field,
                         const std::string& found,
                         const std::string& expected) {
    throw WireError(ErrorCode::bad_image, field, found, expected);
}

void check_amount(const char* field, float value) {
    if (!(value >= 0) || std::isinf(value)) {
        refuse(field, std::to_string(value), "a finite number, 0 or more");
    }
}

void check_integer(const char* field, std::uint64_t value) {
    if (value > kMaxInteger) {
        refuse(field, std::to_string(value), "at most 2^53 - 1");
    }
}

void check_side(const char* field, std::uint32_t value) {
    if (value < 1 || value > kMaxImageSide) {
        refuse(field, std::to_string(value), "1 … " + std::to_string(kMaxImageSide));
    }
}

void check(const ImageHeader& header) {
    if (header.encoding != ImageEncoding::jpeg &&
        header.encoding != ImageEncoding::half_planes) {
        refuse("encoding", std::to_string(static_cast<unsigned>(header.encoding)),
               "1 (JPEG) or 2 (half planes)");
    }
    check_side("width", header.width);
    check_side("height", header.height);
    if (std::uint64_t{header.width} * header.height > kMaxImagePixels) {
        refuse("height",
               std::to_string(header.width) + "×" + std::to_string(header.height) + " pixels",
               "at most " + std::to_string(kMaxImagePixels) + " pixels");
    }
    check_integer("revision", header.revision);
    check_integer("sequence", header.sequence);
    check_amount("relative_error", header.relative_error);
    if (header.exact && header.relative_error > 0) {
        refuse("relative_error", std::to_string(header.relative_error), "0 in an exact image");
    }
    if (header.has_alpha && header.encoding != ImageEncoding::half_planes) {
        refuse("flags", "alpha in a JPEG", "alpha only in half planes");
    }
    check_amount("edit_to_image_ms", header.edit_to_image_ms);
    check_amount("relight_ms", header.relight_ms);
    check_amount("encode_ms", header.encode_ms);
    if (header.exact && header.coefficients_remaining != 0) {
        refuse("coefficients_remaining", std::to_string(header.coefficients_remaining),
               "0 in an exact image");
    }
}

}  // namespace

std::array<std::byte, kImageHeaderBytes> encode_image_header(const ImageHeader& header) {
    check(header);
    std::array<std::byte, kImageHeaderBytes> bytes{};
    store(bytes, kAtMagic, kMagic);
    store(bytes, kAtVersion, kImageHeaderVersion);
    store(bytes, kAtEncoding, static_cast<std::uint16_t>(header.encoding));
    store(bytes, kAtWidth, header.width);
    store(bytes, kAtHeight, header.height);
    store(bytes, kAtRevision, header.revision);
    store(bytes, kAtSequence, header.sequence);
    store(bytes, kAtError, header.relative_error);
    store(bytes, kAtFlags,
          (header.exact ? kExactFlag : 0U) | (header.has_alpha ? kAlphaFlag : 0U));
    store(bytes, kAtEditToImage, header.edit_to_image_ms);
    store(bytes, kAtRelight, header.relight_ms);
    store(bytes, kAtEncode, header.encode_ms);
    store(bytes, kAtApplied, header.coefficients_applied);
    store(bytes, kAtPayload, header.payload_bytes);
    store(bytes, kAtRemaining, header.coefficients_remaining);
    return bytes;
}

ImageHeader decode_image_header(std::span<const std::byte> frame) {
    if (frame.size() < kImageHeaderBytes) {
        refuse("frame", std::to_string(frame.size()) + " bytes",
               "at least " + std::to_string(kImageHeaderBytes) + " bytes");
    }
    if (const auto magic = load<std::uint32_t>(frame, kAtMagic); magic != kMagic) {
        refuse("magic", std::to_string(magic), "RLMI");
    }
    if (const auto version = load<std::uint16_t>(frame, kAtVersion);
        version != kImageHeaderVersion) {
        refuse("version", std::to_string(version), std::to_string(kImageHeaderVersion));
    }
    const auto flags = load<std::uint32_t>(frame, kAtFlags);
    const ImageHeader header{
        .encoding = static_cast<ImageEncoding>(load<std::uint16_t>(frame, kAtEncoding)),
        .width = load<std::uint32_t>(frame, kAtWidth),
        .height = load<std::uint32_t>(frame, kAtHeight),
        .revision = load<std::uint64_t>(frame, kAtRevision),
        .sequence = load<std::uint64_t>(frame, kAtSequence),
        .relative_error = load_float(frame, kAtError),
        .exact = (flags & kExactFlag) != 0,
        .has_alpha = (flags & kAlphaFlag) != 0,
        .edit_to_image_ms = load_float(frame, kAtEditToImage),
        .relight_ms = load_float(frame, kAtRelight),
        .encode_ms = load_float(frame, kAtEncode),
        .coefficients_applied = load<std::uint32_t>(frame, kAtApplied),
        .payload_bytes = load<std::uint32_t>(frame, kAtPayload),
        .coefficients_remaining = load<std::uint32_t>(frame, kAtRemaining),
    };
    if ((flags & ~(kExactFlag | kAlphaFlag)) != 0) {
        refuse("flags", std::to_string(flags), "bits 0 and 1 only");
    }
    check(header);
    const std::size_t payload_bytes = frame.size() - kImageHeaderBytes;
    if (header.payload_bytes != payload_bytes || payload_bytes == 0) {
        refuse("payload_bytes", std::to_string(header.payload_bytes),
               payload_bytes == 0 ? "a payload"
                                  : std::to_string(payload_bytes) + ", the rest of the frame");
    }
    return header;
}

}  // namespace relume::wire
