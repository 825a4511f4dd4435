// What one peer may cost the other. The server states the values in force in its snapshot.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>

namespace relume::wire {

struct Limits {
    std::uint64_t message_bytes = 64 * 1024;  // one text frame from a client
    std::uint64_t messages_per_second = 256;
    std::uint64_t message_burst = 512;
    std::uint64_t lights_per_room = 64;
    std::uint64_t materials_per_room = 16;
    std::uint64_t finishes_per_room = 64;
    std::uint64_t clients_per_room = 64;
    std::uint64_t rooms = 64;
    std::uint64_t images_in_flight = 2;  // per client, not yet acknowledged
    std::uint64_t upload_bytes = std::uint64_t{64} * 1024 * 1024;
    std::uint64_t uploads = 32;
    std::uint64_t errors_per_connection = 100;
    std::uint64_t image_pixels = std::uint64_t{4096} * 2160;  // where people choose its size

    friend bool operator==(const Limits&, const Limits&) = default;
};

// Ids, revisions and sequence numbers stay within what a JSON number holds in every language.
inline constexpr std::uint64_t kMaxInteger = (std::uint64_t{1} << 53) - 1;
// What a client accepts from a server in one text frame: a snapshot with all lights is far
// below.
inline constexpr std::size_t kMaxServerMessageBytes = std::size_t{1} << 20;
// Largest image side, as in the transport directory, and largest image.
inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 26;
// Largest image side that an edit may ask for.
inline constexpr std::uint32_t kMaxChosenSide = 4096;

// An object with one key per member, each named like the member.
[[nodiscard]] nlohmann::json to_json(const Limits& limits);
// Unknown keys are ignored (a newer server may state more); missing ones keep their default.
// Throws WireError when a value is not a non-negative integer.
[[nodiscard]] Limits limits_from_json(const nlohmann::json& object);

}  // namespace relume::wire
