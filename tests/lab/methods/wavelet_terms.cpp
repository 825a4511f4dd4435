#include "tests/lab/methods/wavelet_terms.h"

#include "protocol/relighting/strategy.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

constexpr auto kAnyNumber = std::numeric_limits<std::uint32_t>::max();
constexpr auto kAnyBytes = std::numeric_limits<std::uint64_t>::max();

std::optional<engine::SelectionBudget> budget_from_text(std::string_view text) {
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

bool WaveletTerms::counts_bytes() const {
    return budget.bytes != kAnyBytes;
}

WaveletTerms wavelet_terms_from_text(std::string_view text) {
    const std::size_t dash = text.find('-');
    const std::string_view budget_text = text.substr(0, dash);
    const std::string_view priority_text =
        dash == std::string_view::npos ? "area" : text.substr(dash + 1);
    const auto budget = budget_from_text(budget_text);
    if (!budget) {
        throw std::invalid_argument(
            fmt::format("budget '{}', expected a number of coefficients, or of bytes with B, "
                        "kB or MB after it",
                        budget_text));
    }
    const auto priority = relighting::kPriorityNames.value(priority_text);
    if (!priority) {
        throw std::invalid_argument(fmt::format("priority '{}', expected {}", priority_text,
                                                relighting::kPriorityNames.alternatives()));
    }
    return {.budget = *budget,
            .priority = *priority,
            .text = fmt::format("{}-{}", budget_text, priority_text)};
}

}  // namespace relume::lab
