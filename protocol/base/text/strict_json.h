// Strict JSON [RFC 8259] from files and peers that may mean harm: the one way in which JSON is
// read.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace relume::text {

// Arrays and objects within one another. Copying and printing a value recurse, so that a bound
// on depth is a bound on the stack.
inline constexpr std::size_t kMaxJsonDepth = 16;

enum class JsonFault : std::uint8_t { malformed, number_out_of_range, too_large };

// The message is "found …, expected …"; what was found begins with its line and column.
class JsonError : public std::runtime_error {
  public:
    JsonError(JsonFault fault, std::string found, std::string expected);

    [[nodiscard]] JsonFault fault() const { return fault_; }
    [[nodiscard]] const std::string& found() const { return found_; }
    [[nodiscard]] const std::string& expected() const { return expected_; }

  private:
    JsonFault fault_;
    std::string found_;
    std::string expected_;
};

// Throws JsonError for a text above `max_bytes`, bad syntax, invalid UTF-8, a NUL, a key given
// twice in one object, nesting beyond kMaxJsonDepth, or a number beyond double precision.
[[nodiscard]] nlohmann::json parse_strict_json(std::string_view text, std::size_t max_bytes);

// A value as an error message quotes it: its JSON text, cut after some 60 characters; whatever
// bytes it holds, the quotation is valid UTF-8 and control characters in it are escaped.
[[nodiscard]] std::string quote(const nlohmann::json& value);

// Where byte `offset` of a text stands: "line 3, column 14", both from 1, columns counted in
// characters.
[[nodiscard]] std::string position_in_text(std::string_view text, std::size_t offset);

}  // namespace relume::text
