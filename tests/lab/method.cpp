#include "tests/lab/method.h"

#include "protocol/wire/session_names.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace relume::lab {
namespace {

// Takes the part before the next dash off the front of `text`.
std::string_view take_part(std::string_view& text) {
    const std::size_t dash = text.find('-');
    const std::string_view part = text.substr(0, dash);
    text = dash == std::string_view::npos ? std::string_view() : text.substr(dash + 1);
    return part;
}

}  // namespace

std::string Method::label() const {
    return fmt::format("{}-{}-{}", wire::name_from(strategy.method), coefficients,
                       wire::name_from(strategy.priority));
}

Method method_from_text(std::string_view text) {
    std::string_view rest = text;
    const auto name = wire::kMethodNames.value(take_part(rest));
    const std::string_view count = take_part(rest);
    const auto priority = wire::kPriorityNames.value(rest.empty() ? "area" : rest);
    std::uint32_t coefficients = 0;
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), coefficients);
    if (!name || !priority || error != std::errc() || end != count.data() + count.size() ||
        coefficients == 0) {
        throw std::invalid_argument(fmt::format(
            "method '{}': expected nwa|bi|pbi-COEFFICIENTS[-area|-none|-transport]", text));
    }
    return {.strategy = {.method = *name, .priority = *priority}, .coefficients = coefficients};
}

}  // namespace relume::lab
