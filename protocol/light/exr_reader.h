// Little-endian values out of an EXR file's bytes, which may end anywhere.
#pragma once

#include "protocol/light/environment_error.h"

#include <fmt/core.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>

namespace relume::light {

// Keeps a reference to the bytes. Every take throws as refuse_incomplete does where they end.
// Not thread-safe.
class ExrReader {
  public:
    static constexpr std::size_t kMostNameBytes = 255;

    explicit ExrReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    [[nodiscard]] std::size_t at() const { return at_; }

    template <typename Number>
    Number number() {
        Number value{};
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

    std::span<const std::byte> take(std::size_t count) {
        if (count > left()) {
            refuse_incomplete("in its header");
        }
        const auto taken = bytes_.subspan(at_, count);
        at_ += count;
        return taken;
    }

    // Up to a zero byte; throws as refuse_image where that comes too late.
    std::string name() {
        std::string text;
        for (;;) {
            const char c = number<char>();
            if (c == '\0') {
                return text;
            }
            if (text.size() == kMostNameBytes) {
                refuse_image("header", "one with a name that does not end",
                             fmt::format("names of at most {} bytes", kMostNameBytes));
            }
            text += c;
        }
    }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

}  // namespace relume::light
