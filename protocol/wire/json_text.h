// Strict JSON from a peer: what text/strict_json.h refuses becomes a refusal of the wire.
#pragma once

#include "protocol/base/text/strict_json.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace relume::wire {

using text::kMaxJsonDepth;
using text::quote;

// Throws WireError: too_large above `max_bytes`; out_of_range for a number beyond double;
// malformed_json for all else that parse_strict_json refuses, with line and column.
[[nodiscard]] nlohmann::json parse_json(std::string_view json, std::size_t max_bytes);

// `path` with one more step, escaped [RFC 6901 §3]. A key beyond 128 bytes is cut, and ends in
// "…".
[[nodiscard]] std::string pointer_step(std::string_view path, std::string_view key);

}  // namespace relume::wire
