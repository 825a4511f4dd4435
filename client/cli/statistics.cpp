#include "client/cli/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace relume::cli {

double percentile(std::span<const double> sorted, double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
    const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
    return sorted[std::min(index, sorted.size() - 1)];
}

Spread spread_of(std::vector<double> values) {
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return {.count = values.size(),
            .mean = sum / static_cast<double>(values.size()),
            .p50 = percentile(values, 0.5),
            .p99 = percentile(values, 0.99),
            .highest = values.back()};
}

void put_spread(nlohmann::json& object, const char* prefix, const Spread& spread) {
    const auto put = [&](const char* suffix, double value) {
        object[std::string(prefix) + suffix] =
            spread.count == 0 ? nlohmann::json() : nlohmann::json(value);
    };
    put("_p50", spread.p50);
    put("_p99", spread.p99);
    put("_mean", spread.mean);
    put("_max", spread.highest);
}

}  // namespace relume::cli
