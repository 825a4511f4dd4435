// Order statistics of what was measured.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace relume::cli {

// The smallest value that at least `fraction` (0 … 1) of all are not above (nearest rank): one
// that was really measured. `sorted` ascends and is not empty.
[[nodiscard]] double percentile(std::span<const double> sorted, double fraction);

struct Spread {
    std::size_t count = 0;
    double mean = 0;
    double p50 = 0;
    double p99 = 0;
    double highest = 0;
};

// All zero when there are no values.
[[nodiscard]] Spread spread_of(std::vector<double> values);

// {"PREFIX_p50", "PREFIX_p99", "PREFIX_mean", "PREFIX_max"} into `object`; null without values.
void put_spread(nlohmann::json& object, const char* prefix, const Spread& spread);

}  // namespace relume::cli
