#include "tests/lab/method.h"

#include "protocol/wire/session_names.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

// Takes the part before the next dash off the front of `text`.
std::string_view take_part(std::string_view& text) {
    const std::size_t dash = text.find('-');
    const std::string_view part = text.substr(0, dash);
    text = dash == std::string_view::npos ? std::string_view() : text.substr(dash + 1);
    return part;
}

std::optional<engine::SelectionBudget> budget_from_text(std::string_view text) {
    constexpr auto kAnyNumber = std::numeric_limits<std::uint32_t>::max();
    constexpr auto kAnyBytes = std::numeric_limits<std::uint64_t>::max();
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    if (error != std::errc() || number == 0) {
        return std::nullopt;
    }
    if (unit.empty()) {
        return engine::SelectionBudget{.columns = number, .bytes = kAnyBytes};
    }
    constexpr std::pair<std::string_view, std::uint64_t> kUnits[] = {
        {"B", 1}, {"kB", 1000}, {"MB", 1000000}};
    for (const auto& [name, bytes] : kUnits) {
        if (unit == name) {
            return engine::SelectionBudget{.columns = kAnyNumber, .bytes = number * bytes};
        }
    }
    return std::nullopt;
}

}  // namespace

std::string Method::label() const {
    return fmt::format("{}-{}-{}", wire::name_from(strategy.method), budget_text,
                       wire::name_from(strategy.priority));
}

Method method_from_text(std::string_view text) {
    std::string_view rest = text;
    const auto name = wire::kMethodNames.value(take_part(rest));
    const std::string_view budget_text = take_part(rest);
    const auto budget = budget_from_text(budget_text);
    const auto priority = wire::kPriorityNames.value(rest.empty() ? "area" : rest);
    if (!name || !priority || !budget) {
        throw std::invalid_argument(
            fmt::format("method '{}': expected nwa|bi|pbi|guarded-BUDGET"
                        "[-area|-none|-transport|-benefit], the budget a number of "
                        "coefficients, or of bytes with B, kB or MB after it",
                        text));
    }
    return {.strategy = {.method = *name, .priority = *priority},
            .budget = *budget,
            .budget_text = std::string(budget_text)};
}

}  // namespace relume::lab
