// What can go wrong on the wire, by the names a client sees.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace relume::wire {

enum class ErrorCode : std::uint8_t {
    malformed_json,
    unknown_type,
    unknown_field,
    wrong_type,
    out_of_range,
    missing_field,
    unknown_name,
    too_many,
    too_large,
    unsupported,
    not_found,
    bad_image,
    shutting_down,
    internal
};

[[nodiscard]] std::string_view name_from_error_code(ErrorCode code);
[[nodiscard]] std::optional<ErrorCode> error_code_from_name(std::string_view name);

// WebSocket close codes [RFC 6455 §7.4]; 4000 and above are Relume's own.
enum class CloseCode : std::uint16_t {
    bye = 1000,
    shutting_down = 1001,
    not_text = 1003,
    message_too_big = 1009,
    bad_token = 4001,
    too_fast = 4002,
    room_full = 4003,
    unknown_scene = 4004,
    too_many_errors = 4005,
    does_not_read = 4006,
    too_many_rooms = 4007
};

// What the close frame says, and a client shows; below 123 bytes as the close frame demands.
[[nodiscard]] std::string_view reason_from_close_code(CloseCode code);
[[nodiscard]] std::optional<CloseCode> close_code_from_number(std::uint16_t number);

// A refused message. `path` is a JSON pointer [RFC 6901] to the offending value: into the patch
// for what an edit holds ("/environment/gain"), into the message for the rest ("/type"); for a
// binary frame it is the name of the header field. `found` and `expected` are for people.
class WireError : public std::runtime_error {
  public:
    WireError(ErrorCode code, std::string path, std::string found, std::string expected);

    [[nodiscard]] ErrorCode code() const { return code_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& found() const { return found_; }
    [[nodiscard]] const std::string& expected() const { return expected_; }

    // The edit that carried the error, when its id could be read.
    [[nodiscard]] std::optional<std::uint64_t> edit_id() const { return edit_id_; }
    [[nodiscard]] WireError with_edit_id(std::uint64_t id) const;

  private:
    ErrorCode code_;
    std::string path_;
    std::string found_;
    std::string expected_;
    std::optional<std::uint64_t> edit_id_;
};

}  // namespace relume::wire
