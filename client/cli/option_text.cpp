#include "client/cli/option_text.h"

#include "client/cli/client_error.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/split.h"
#include "protocol/base/text/strict_json.h"

#include <fmt/format.h>

#include <charconv>

namespace relume::cli {

std::vector<double> numbers_from_option(std::string_view text,
                                        std::size_t count,
                                        std::string_view option,
                                        std::string_view form) {
    std::vector<double> numbers;
    for (const std::string_view part : text::split(text, ',')) {
        double number = 0;
        const auto [end, error] =
            std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc{} || end != part.data() + part.size()) {
            numbers.clear();
            break;
        }
        numbers.push_back(number);
    }
    if (numbers.size() != count) {
        throw program::UsageError(
            fmt::format("{}: found \"{}\", expected {}", option, text, form));
    }
    return numbers;
}

OptionJson json_from_option(const std::string& text_or_file, const std::string& option) {
    std::string json_text = text_or_file;
    std::string source = option;
    if (json_text.starts_with('@')) {
        source = json_text.substr(1);
        try {
            json_text = files::read_regular_file(source, kMaxOptionJsonBytes);
        } catch (const files::FileError& error) {
            throw ClientError(error.what());
        }
    }
    try {
        return {.value = text::parse_strict_json(json_text, kMaxOptionJsonBytes),
                .source = source};
    } catch (const text::JsonError& error) {
        throw ClientError(source + ": " + error.what());
    }
}

}  // namespace relume::cli
