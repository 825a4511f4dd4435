// A run in a line per method.
#pragma once

#include "tests/lab/measures/record.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace relume::lab {

// Images after the light rests at which errors are told [Overbeck06 §6].
inline constexpr std::uint32_t kSoon = 5;
inline constexpr std::uint32_t kLater = 25;

// Means are over the images while the light moves; of times the median. NaN where the sequence
// has no such image or it was not measured.
struct Summary {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::string method;
    double l2 = kNone;
    double h1 = kNone;
    double lighting_l1 = kNone;
    double flicker = kNone;
    double visible = kNone;
    double bytes = kNone;
    double microseconds = kNone;
    double soon_l2 = kNone;             // kSoon images after the light rests
    double later_l2 = kNone;            // kLater
    double last_l2 = kNone;             // of the last image
    double least_stated_ratio = kNone;  // stated over true L2 error, where that is above 10⁻⁴
    double largest_stated_ratio = kNone;
};

// In the order in which methods first occur.
[[nodiscard]] std::vector<Summary> summaries(const std::vector<Record>& records,
                                             std::uint32_t rests_from);

// The methods that occur, in order.
[[nodiscard]] std::vector<std::string> methods_of(const std::vector<Record>& records);
// The records of one method, in order.
[[nodiscard]] std::vector<Record> records_of(const std::vector<Record>& records,
                                             const std::string& method);

}  // namespace relume::lab
