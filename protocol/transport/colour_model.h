// How the colours of a transport come of its stored channels.
#pragma once

#include "protocol/transport/format.h"
#include "protocol/transport/manifest_reader.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>

namespace relume::transport {

// Colours from stored channels: colour c = Σ_k matrix[c][k]·channel k. Rows beyond `channels`
// are unused and zero.
struct ColourModel {
    std::uint32_t channels = 1;
    std::array<std::array<float, kMaxChannels>, kColours> matrix{};
};

// The manifest's section `colour`. Reading throws TransportError naming the key, what was found
// and what was expected.
[[nodiscard]] nlohmann::json json_from(const ColourModel& colour);
[[nodiscard]] ColourModel colour_model(const ManifestReader& object);

}  // namespace relume::transport
