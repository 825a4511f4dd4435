// XXH3-64 (seed 0) of bytes, and its text form of 16 lower-case hexadecimal digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace relume::transport {

[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes);
// Of the parts one after another.
[[nodiscard]] std::uint64_t checksum(std::span<const std::span<const std::byte>> parts);
[[nodiscard]] std::string text_from_checksum(std::uint64_t value);
// Empty when `text` is not exactly 16 lower-case hexadecimal digits.
[[nodiscard]] std::optional<std::uint64_t> checksum_from_text(std::string_view text);

}  // namespace relume::transport
