#include "tests/lab/measures/summary.h"

#include "tests/support/timing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace relume::lab {
namespace {

using Value = std::function<double(const Record&)>;

double mean(const std::vector<Record>& records, const Value& value) {
    double sum = 0;
    for (const Record& record : records) {
        sum += value(record);
    }
    return sum / static_cast<double>(records.size());
}

double l2_of_image(const std::vector<Record>& records, std::uint32_t image) {
    const auto found = std::find_if(records.begin(), records.end(), [&](const Record& record) {
        return record.image == image;
    });
    return found == records.end() ? Summary::kNone : found->error.l2;
}

void summarise_stated(const std::vector<Record>& records, Summary& summary) {
    constexpr double kTelling = 1e-4;
    for (const Record& record : records) {
        if (record.error.l2 > kTelling) {
            const double ratio = record.stated_error / record.error.l2;
            summary.least_stated_ratio = std::fmin(summary.least_stated_ratio, ratio);
            summary.largest_stated_ratio = std::fmax(summary.largest_stated_ratio, ratio);
        }
    }
}

Summary summary_of(const std::vector<Record>& records, std::uint32_t rests_from) {
    Summary summary{.method = records.front().method};
    std::vector<Record> moving;
    std::copy_if(records.begin(), records.end(), std::back_inserter(moving),
                 [&](const Record& record) { return record.image < rests_from; });
    if (!moving.empty()) {
        summary.l2 = mean(moving, [](const Record& r) { return r.error.l2; });
        summary.h1 = mean(moving, [](const Record& r) { return r.error.h1; });
        summary.lighting_l1 = mean(moving, [](const Record& r) { return r.lighting_l1; });
        summary.flicker = mean(moving, [](const Record& r) { return r.flicker; });
        summary.bytes =
            mean(moving, [](const Record& r) { return static_cast<double>(r.bytes); });
        std::vector<Record> seen;
        std::copy_if(moving.begin(), moving.end(), std::back_inserter(seen),
                     [](const Record& record) { return record.visible.has_value(); });
        summary.visible = mean(seen, [](const Record& r) { return *r.visible; });
        std::vector<double> times;
        for (const Record& record : moving) {
            times.push_back(record.microseconds);
        }
        summary.microseconds = test::median(times);
    }
    summary.soon_l2 = l2_of_image(records, rests_from + kSoon);
    summary.later_l2 = l2_of_image(records, rests_from + kLater);
    summary.last_l2 = records.back().error.l2;
    summarise_stated(records, summary);
    return summary;
}

}  // namespace

std::vector<Summary> summaries(const std::vector<Record>& records, std::uint32_t rests_from) {
    std::vector<Summary> lines;
    for (const std::string& method : methods_of(records)) {
        lines.push_back(summary_of(records_of(records, method), rests_from));
    }
    return lines;
}

std::vector<std::string> methods_of(const std::vector<Record>& records) {
    std::vector<std::string> methods;
    for (const Record& record : records) {
        if (std::find(methods.begin(), methods.end(), record.method) == methods.end()) {
            methods.push_back(record.method);
        }
    }
    return methods;
}

std::vector<Record> records_of(const std::vector<Record>& records, const std::string& method) {
    std::vector<Record> own;
    std::copy_if(records.begin(), records.end(), std::back_inserter(own),
                 [&](const Record& record) { return record.method == method; });
    return own;
}

}  // namespace relume::lab
