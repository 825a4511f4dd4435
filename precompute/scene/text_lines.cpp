#include "precompute/scene/text_lines.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>

namespace relume::scene {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

std::string text_of(const std::filesystem::path& path, std::uint64_t max_bytes) {
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(path, error);
    if (!error && bytes > max_bytes)
        throw SceneError(SceneFault::too_large,
                         fmt::format("'{}' has {} bytes; expected at most {}",
                                     shown_text(path.string()), bytes, max_bytes));
    std::string text(error ? 0 : bytes, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (error || !stream)
        throw SceneError(SceneFault::corrupt_file,
                         fmt::format("'{}' cannot be read", shown_text(path.string())));
    return text;
}

TextLines::TextLines(std::string_view text) : text_(text) {
    if (text_.substr(0, kByteOrderMark.size()) == kByteOrderMark)
        text_.remove_prefix(kByteOrderMark.size());
}

std::string_view TextLines::take_line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
    const std::string_view line = text_.substr(0, end);
    const bool is_crlf = text_.substr(end, 2) == "\r\n";
    text_.remove_prefix(std::min(end + (is_crlf ? 2 : 1), text_.size()));
    ++line_;
    return line;
}

bool TextLines::next() {
    while (!text_.empty()) {
        std::string_view line = take_line();
        first_line_ = line_;
        if (trimmed(line).ends_with('\\') && !trimmed(line).starts_with('#')) {
            joined_.clear();
            while (trimmed(line).ends_with('\\')) {
                const std::string_view part = trimmed(line);
                joined_ += part.substr(0, part.size() - 1);
                joined_ += ' ';
                line = text_.empty() ? std::string_view() : take_line();
            }
            joined_ += line;
            line = joined_;
        }
        line = trimmed(line);
        if (line.empty() || line.front() == '#')
            continue;
        rest_ = line;
        keyword_ = take_word(rest_);
        rest_ = trimmed(rest_);
        return true;
    }
    return false;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view take_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    return word;
}

std::optional<double> number_from(std::string_view word) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty())
        return std::nullopt;
    if (error == std::errc::result_out_of_range)  // 1e-400, or 1e400: what strtod makes of it
        return std::strtod(std::string(word).c_str(), nullptr);
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

std::size_t take_numbers(std::string_view& text, std::span<double> values) {
    std::size_t count = 0;
    while (count < values.size()) {
        std::string_view rest = text;
        const auto value = number_from(take_word(rest));
        if (!value)
            break;
        values[count++] = *value;
        text = rest;
    }
    return count;
}

}  // namespace relume::scene
