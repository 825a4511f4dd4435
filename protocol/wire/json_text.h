// Strict JSON [RFC 8259] from a peer that may mean harm.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace relume::wire {

// Throws WireError: too_large above `max_bytes`; malformed_json for bad syntax, invalid UTF-8,
// a key given twice, or nesting beyond kMaxJsonDepth; out_of_range for a number beyond double.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, std::size_t max_bytes);

// A value as an error message quotes it: its JSON text, cut after some 60 characters.
[[nodiscard]] std::string quote(const nlohmann::json& value);

// `path` with one more step, escaped [RFC 6901 §3].
[[nodiscard]] std::string pointer_step(std::string_view path, std::string_view key);

}  // namespace relume::wire
