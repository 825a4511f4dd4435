#include "client/cli/finish_options.h"

#include "client/cli/option_text.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/split.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace relume::cli {
namespace {

using nlohmann::json;

constexpr std::string_view kOption = "--finish";
constexpr std::string_view kForm =
    "PART=MATERIAL, PART=MATERIAL@NUMBER or one of these and :R,G,B for each lobe";

json finish_from(std::string_view text) {
    const std::vector<std::string_view> words = text::split(text, ':');
    json finish = json::object();
    const std::size_t at = words[0].find('@');
    finish["material"] = std::string(words[0].substr(0, at));
    if (at != std::string_view::npos) {
        finish["parameter"] =
            numbers_from_option(words[0].substr(at + 1), 1, kOption, kForm).front();
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
        finish["colours"].push_back(numbers_from_option(words[i], 3, kOption, kForm));
    }
    return finish;
}

}  // namespace

json finishes_from_options(const std::vector<std::string>& options) {
    json finishes = json::object();
    for (const std::string& option : options) {
        const std::size_t equals = option.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == option.size()) {
            throw program::UsageError(
                fmt::format("{}: found \"{}\", expected {}", kOption, option, kForm));
        }
        finishes[option.substr(0, equals)] =
            finish_from(std::string_view(option).substr(equals + 1));
    }
    return finishes;
}

}  // namespace relume::cli
