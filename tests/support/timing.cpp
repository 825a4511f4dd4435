#include "tests/support/timing.h"

#include "protocol/base/timing/stopwatch.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

namespace relume::test {

std::vector<std::vector<double>> seconds_in_turn(std::span<const TimedVariant> variants,
                                                 std::size_t rounds) {
    std::vector<std::vector<double>> seconds(variants.size());
    for (std::size_t round = 0; round <= rounds; ++round) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            const timing::Stopwatch stopwatch;
            variants[v](round);
            const double spent = stopwatch.seconds();
            if (round > 0) {
                seconds[v].push_back(spent);
            }
        }
    }
    return seconds;
}

double median(std::vector<double> values) {
    if (values.empty()) {
        throw std::invalid_argument("median of no values");
    }
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double median_ratio(std::span<const double> a, std::span<const double> b) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        ratios.push_back(a[i] / b[i]);
    }
    return median(std::move(ratios));
}

void with_threads(int threads, const std::function<void()>& work) {
    tbb::task_arena arena(threads);
    arena.execute(work);
}

}  // namespace relume::test
