// What relume-decode answers on its standard output. Internal to protocol/light.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::decoder {

inline constexpr std::uint32_t kReplyMagic = 0x49444C52;  // "RLDI"
inline constexpr std::size_t kMaxReplyTextBytes = 16384;

enum class ReplyStatus : std::uint32_t { decoded = 0, refused = 1 };

// Between two programs built together on one machine, hence a plain struct. It is followed by
// `text_bytes` of text and, if decoded, `width·height·3` floats, row-major RGB. The text is a
// sequence of lines, each ended by '\n': the layer used, `warnings` warnings and then the
// layers there are; or message, found and expected.
struct ReplyHeader {
    std::uint32_t magic = kReplyMagic;
    ReplyStatus status = ReplyStatus::refused;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t projection = 0;
    std::uint32_t warnings = 0;
    std::uint32_t text_bytes = 0;
};

}  // namespace relume::decoder
