// Honest times on a machine that is not ours alone.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace relume::test {

// What is compared takes turns, A B C A B C …, so that whatever else the machine does hits all
// alike. Each is called with the number of the round; round 0 warms up and is not counted.
// Returns seconds, [variant][round].
using TimedVariant = std::function<void(std::size_t round)>;
[[nodiscard]] std::vector<std::vector<double>> seconds_in_turn(
    std::span<const TimedVariant> variants, std::size_t rounds);

// The median; of an even count the mean of the two in the middle. Throws std::invalid_argument
// when there is none.
[[nodiscard]] double median(std::vector<double> values);

// Median of a[i]/b[i]: both of a pair met the same neighbours on the machine.
[[nodiscard]] double median_ratio(std::span<const double> a, std::span<const double> b);

// Runs in an oneTBB arena of so many threads.
void with_threads(int threads, const std::function<void()>& work);

}  // namespace relume::test
