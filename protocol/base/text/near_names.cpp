#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace relume::text {
namespace {

constexpr std::size_t kMaxCompared = 256;
constexpr std::size_t kMaxNear = 3;
constexpr std::size_t kMaxListed = 8;

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

// "a", "a or b", "a, b or c".
std::string alternatives(std::span<const std::string> names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += i == 0 ? "" : i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    const std::string first = lower_case(a);
    const std::string second = lower_case(b);
    // Rows of the table of distances between beginnings: this one and the two before it.
    std::array<std::vector<std::size_t>, 3> rows;
    for (auto& row : rows) {
        row.resize(second.size() + 1);
    }
    for (std::size_t j = 0; j <= second.size(); ++j) {
        rows[0][j] = j;
    }
    for (std::size_t i = 1; i <= first.size(); ++i) {
        auto& row = rows[i % 3];
        const auto& above = rows[(i + 2) % 3];
        const auto& two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (std::size_t j = 1; j <= second.size(); ++j) {
            const std::size_t change = first[i - 1] == second[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && first[i - 1] == second[j - 2] &&
                first[i - 2] == second[j - 1]) {
                row[j] = std::min(row[j], two_above[j - 2] + 1);
            }
        }
    }
    return rows[first.size() % 3][second.size()];
}

std::vector<std::string> near_names(std::string_view name, std::span<const std::string> known) {
    if (name.empty() || name.size() > kMaxCompared) {
        return {};
    }
    const std::string lower = lower_case(name);
    const std::size_t allowed = std::max<std::size_t>(1, name.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& other : known) {
        if (other.size() > kMaxCompared) {
            continue;
        }
        const std::size_t distance = edit_distance(name, other);
        const std::string lower_other = lower_case(other);
        constexpr std::size_t kFewestShared = 3;
        const bool part = name.size() >= kFewestShared &&
                          (lower_other.starts_with(lower) || lower_other.ends_with(lower));
        if (distance <= allowed || part) {
            near.emplace_back(distance, other);
        }
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), kMaxNear));
    std::vector<std::string> names;
    for (auto& [distance, other] : near) {
        names.push_back(std::move(other));
    }
    return names;
}

std::string expected_name(std::string_view name,
                          std::span<const std::string> known,
                          std::string_view what) {
    if (known.empty()) {
        return fmt::format("one of the {}, and there are none", what);
    }
    if (const auto near = near_names(name, known); !near.empty()) {
        return fmt::format("one of the {}; did you mean {}?", what, alternatives(near));
    }
    if (known.size() <= kMaxListed) {
        return fmt::format("one of the {} {}", what, fmt::join(known, ", "));
    }
    return fmt::format("one of {} {} such as {}", known.size(), what,
                       fmt::join(known.first(kMaxListed), ", "));
}

}  // namespace relume::text
