#include "protocol/transport/checksum.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <charconv>
#include <memory>
#include <new>

namespace relume::transport {

std::uint64_t checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t checksum(std::span<const std::span<const std::byte>> parts) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    if (state == nullptr) {
        throw std::bad_alloc();
    }
    XXH3_64bits_reset(state.get());
    for (const std::span<const std::byte> part : parts) {
        XXH3_64bits_update(state.get(), part.data(), part.size());
    }
    return XXH3_64bits_digest(state.get());
}

std::string text_from_checksum(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

std::optional<std::uint64_t> checksum_from_text(std::string_view text) {
    constexpr std::size_t kDigits = 16;
    if (text.size() != kDigits ||
        text.find_first_not_of("0123456789abcdef") != std::string_view::npos) {
        return std::nullopt;
    }
    std::uint64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value, kDigits);
    return value;
}

}  // namespace relume::transport
