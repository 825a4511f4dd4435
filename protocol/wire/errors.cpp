#include "protocol/wire/errors.h"

#include "protocol/base/text/name_table.h"

namespace relume::wire {
namespace {

constexpr text::NameTable<ErrorCode, 14> kErrorNames({{
    {ErrorCode::malformed_json, "malformed_json"},
    {ErrorCode::unknown_type, "unknown_type"},
    {ErrorCode::unknown_field, "unknown_field"},
    {ErrorCode::wrong_type, "wrong_type"},
    {ErrorCode::out_of_range, "out_of_range"},
    {ErrorCode::missing_field, "missing_field"},
    {ErrorCode::unknown_name, "unknown_name"},
    {ErrorCode::too_many, "too_many"},
    {ErrorCode::too_large, "too_large"},
    {ErrorCode::unsupported, "unsupported"},
    {ErrorCode::not_found, "not_found"},
    {ErrorCode::bad_image, "bad_image"},
    {ErrorCode::shutting_down, "shutting_down"},
    {ErrorCode::internal, "internal"},
}});

constexpr text::NameTable<CloseCode, 11> kCloseReasons({{
    {CloseCode::bye, "bye"},
    {CloseCode::shutting_down, "shutting down"},
    {CloseCode::not_text, "binary frame from a client"},
    {CloseCode::message_too_big, "message longer than the limit"},
    {CloseCode::bad_token, "bad token"},
    {CloseCode::too_fast, "too many messages per second"},
    {CloseCode::room_full, "room full"},
    {CloseCode::unknown_scene, "unknown scene, or another than the room's"},
    {CloseCode::too_many_errors, "too many errors"},
    {CloseCode::does_not_read, "does not read"},
    {CloseCode::too_many_rooms, "too many rooms"},
}});

std::string message_from_parts(ErrorCode code,
                               const std::string& path,
                               const std::string& found,
                               const std::string& expected) {
    std::string message(name_from_error_code(code));
    if (!path.empty()) {
        message += " at " + path;
    }
    message += ": found " + found;
    if (!expected.empty()) {
        message += ", expected " + expected;
    }
    return message;
}

}  // namespace

std::string_view name_from_error_code(ErrorCode code) {
    return kErrorNames.name(code);
}

std::optional<ErrorCode> error_code_from_name(std::string_view name) {
    return kErrorNames.value(name);
}

std::string_view reason_from_close_code(CloseCode code) {
    return kCloseReasons.name(code);
}

std::optional<CloseCode> close_code_from_number(std::uint16_t number) {
    const auto code = static_cast<CloseCode>(number);
    return kCloseReasons.name(code).empty() ? std::nullopt : std::optional(code);
}

WireError::WireError(ErrorCode code, std::string path, std::string found, std::string expected)
    : std::runtime_error(message_from_parts(code, path, found, expected)),
      code_(code),
      path_(std::move(path)),
      found_(std::move(found)),
      expected_(std::move(expected)) {}

WireError WireError::with_edit_id(std::uint64_t id) const {
    WireError error(*this);
    error.edit_id_ = id;
    return error;
}

}  // namespace relume::wire
