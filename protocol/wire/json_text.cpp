#include "protocol/wire/json_text.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/limits.h"

#include <nlohmann/json.hpp>

#include <set>
#include <vector>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr std::size_t kQuotedCharacters = 60;

// Watches the parser's events for what nlohmann::json lets pass: repeated keys, deep nesting.
class StructureCheck {
  public:
    bool operator()(int /*depth*/, json::parse_event_t event, const json& parsed) {
        switch (event) {
            case json::parse_event_t::object_start:
            case json::parse_event_t::array_start:
                if (keys_.size() == kMaxJsonDepth) {
                    throw WireError(ErrorCode::malformed_json, "", "deeper nesting",
                                    "at most " + std::to_string(kMaxJsonDepth) + " levels");
                }
                keys_.emplace_back();
                break;
            case json::parse_event_t::object_end:
            case json::parse_event_t::array_end:
                keys_.pop_back();
                break;
            case json::parse_event_t::key:
                if (!keys_.back().insert(parsed.get_ref<const std::string&>()).second) {
                    throw WireError(ErrorCode::malformed_json, "",
                                    "the key " + quote(parsed) + " twice in one object",
                                    "every key once");
                }
                break;
            case json::parse_event_t::value:
                break;
        }
        return true;
    }

  private:
    std::vector<std::set<std::string>> keys_;
};

std::string cut_at_code_point(std::string text) {
    if (text.size() <= kQuotedCharacters) {
        return text;
    }
    std::size_t end = kQuotedCharacters;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
        --end;
    }
    return text.substr(0, end) + "…";
}

}  // namespace

json parse_json(std::string_view text, std::size_t max_bytes) {
    if (text.size() > max_bytes) {
        throw WireError(ErrorCode::too_large, "", std::to_string(text.size()) + " bytes",
                        "at most " + std::to_string(max_bytes) + " bytes");
    }
    // nlohmann::json takes a NUL for the end of the text and would not look behind it.
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        throw WireError(ErrorCode::malformed_json, "", "a NUL at byte " + std::to_string(nul),
                        "JSON in UTF-8");
    }
    try {
        StructureCheck check;
        return json::parse(text.begin(), text.end(), std::ref(check));
    } catch (const json::parse_error& error) {
        throw WireError(ErrorCode::malformed_json, "",
                        "a fault before byte " + std::to_string(error.byte), "JSON in UTF-8");
    } catch (const json::out_of_range&) {
        throw WireError(ErrorCode::out_of_range, "", "a number beyond double precision's range",
                        "finite numbers");
    }
}

std::string quote(const json& value) {
    // A container is named, not shown: dumping one to keep 60 characters of it costs its size.
    if (value.is_object()) {
        return "an object";
    }
    if (value.is_array()) {
        return "an array of " + std::to_string(value.size());
    }
    if (value.is_string()) {
        return cut_at_code_point(json(cut_at_code_point(value.get_ref<const std::string&>()))
                                     .dump(-1, ' ', false, json::error_handler_t::replace));
    }
    return value.dump();
}

std::string pointer_step(std::string_view path, std::string_view key) {
    std::string pointer(path);
    pointer += '/';
    for (const char c : key) {
        if (c == '~') {
            pointer += "~0";
        } else if (c == '/') {
            pointer += "~1";
        } else {
            pointer += c;
        }
    }
    return pointer;
}

}  // namespace relume::wire
