#include "protocol/base/text/strict_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace relume::text {
namespace {

using nlohmann::json;

constexpr std::size_t kQuotedCharacters = 60;

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

// Hands the parser the text byte by byte and so knows how far it has read.
class ReadingPosition {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    ReadingPosition(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}

    reference operator*() const { return *at_; }
    ReadingPosition& operator++() {
        *furthest_ = ++at_;
        return *this;
    }
    ReadingPosition operator++(int) {
        const ReadingPosition before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const ReadingPosition& a, const ReadingPosition& b) {
        return a.at_ == b.at_;
    }

  private:
    const char* at_;
    const char** furthest_;
};

// Watches the parser's events for what nlohmann::json lets pass: repeated keys, deep nesting.
class StructureCheck {
  public:
    StructureCheck(std::string_view text, const char* const& furthest)
        : text_(text), furthest_(furthest) {}

    bool operator()(int /*depth*/, json::parse_event_t event, const json& parsed) {
        switch (event) {
            case json::parse_event_t::object_start:
            case json::parse_event_t::array_start:
                if (keys_.size() == kMaxJsonDepth) {
                    refuse("deeper nesting", fmt::format("at most {} levels", kMaxJsonDepth));
                }
                keys_.emplace_back();
                break;
            case json::parse_event_t::object_end:
            case json::parse_event_t::array_end:
                keys_.pop_back();
                break;
            case json::parse_event_t::key:
                if (!keys_.back().insert(parsed.get_ref<const std::string&>()).second) {
                    refuse(fmt::format("the key {} twice in one object", quote(parsed)),
                           "every key once");
                }
                break;
            case json::parse_event_t::value:
                break;
        }
        return true;
    }

  private:
    [[noreturn]] void refuse(const std::string& what, std::string expected) const {
        const auto read = static_cast<std::size_t>(furthest_ - text_.data());
        throw JsonError(
            JsonFault::malformed,
            fmt::format("{}: {}", position_in_text(text_, std::max<std::size_t>(read, 1) - 1),
                        what),
            std::move(expected));
    }

    std::string_view text_;
    const char* const& furthest_;
    std::vector<std::set<std::string>> keys_;
};

// The whole character at a byte of the text, quoted.
std::string character_at(std::string_view text, std::size_t offset) {
    if (offset >= text.size()) {
        return "the end of the text";
    }
    std::size_t end = offset + 1;
    while (end < text.size() && end < offset + 4 && continues_character(text[end])) {
        ++end;
    }
    return quote(std::string(text.substr(offset, end - offset)));
}

std::string cut_at_code_point(std::string text) {
    if (text.size() <= kQuotedCharacters) {
        return text;
    }
    std::size_t end = kQuotedCharacters;
    while (end > 0 && continues_character(text[end])) {
        --end;
    }
    return text.substr(0, end) + "…";
}

}  // namespace

JsonError::JsonError(JsonFault fault, std::string found, std::string expected)
    : std::runtime_error(fmt::format("found {}, expected {}", found, expected)),
      fault_(fault),
      found_(std::move(found)),
      expected_(std::move(expected)) {}

json parse_strict_json(std::string_view text, std::size_t max_bytes) {
    if (text.size() > max_bytes) {
        throw JsonError(JsonFault::too_large, fmt::format("{} bytes", text.size()),
                        fmt::format("at most {} bytes", max_bytes));
    }
    // nlohmann::json takes a NUL for the end of the text and would not look behind it.
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        throw JsonError(JsonFault::malformed,
                        fmt::format("{}: a NUL", position_in_text(text, nul)), "JSON in UTF-8");
    }
    const char* furthest = text.data();
    try {
        StructureCheck check(text, furthest);
        return json::parse(ReadingPosition(text.data(), &furthest),
                           ReadingPosition(text.data() + text.size(), &furthest),
                           std::ref(check));
    } catch (const json::parse_error& error) {
        // The byte counts from 1; a text that ends too early is faulted one byte past its end.
        const std::size_t at = std::max<std::size_t>(error.byte, 1) - 1;
        throw JsonError(
            JsonFault::malformed,
            fmt::format("{}: {}", position_in_text(text, at), character_at(text, at)),
            "JSON in UTF-8");
    } catch (const json::out_of_range&) {
        const auto read = static_cast<std::size_t>(furthest - text.data());
        throw JsonError(JsonFault::number_out_of_range,
                        fmt::format("{}: a number beyond double precision's range",
                                    position_in_text(text, std::max<std::size_t>(read, 1) - 1)),
                        "finite numbers");
    }
}

std::string quote(const json& value) {
    // A container is named, not shown: dumping one to keep 60 characters of it costs its size.
    if (value.is_object()) {
        return "an object";
    }
    if (value.is_array()) {
        return fmt::format("an array of {}", value.size());
    }
    if (value.is_string()) {
        return cut_at_code_point(json(cut_at_code_point(value.get_ref<const std::string&>()))
                                     .dump(-1, ' ', false, json::error_handler_t::replace));
    }
    return value.dump();
}

std::string position_in_text(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::string_view row =
        newline == std::string_view::npos ? before : before.substr(newline + 1);
    const auto characters = std::count_if(row.begin(), row.end(),
                                          [](char byte) { return !continues_character(byte); });
    return fmt::format("line {}, column {}", lines + 1, characters + 1);
}

}  // namespace relume::text
