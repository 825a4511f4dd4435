#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace relume::lab {
namespace {

bool is_in(const LightRun& run, Part part, std::uint32_t image) {
    // slow-fast-slow goes four fifths of its way in the middle half of the images that move.
    const bool moves = image < run.rests_from;
    const bool is_fast =
        moves && image >= run.rests_from / 4 && image < run.rests_from - run.rests_from / 4;
    switch (part) {
        case Part::moving:
            return moves;
        case Part::slow:
            return moves && !is_fast;
        case Part::fast:
            return is_fast;
        case Part::whole:
            return true;
    }
    throw std::logic_error("no such part of a run");
}

std::vector<double> values_of(const LightRun& run,
                              const std::string& method,
                              Measure measure,
                              Part part) {
    std::vector<double> values;
    for (const Record& record : run.findings.records) {
        if (record.method == method && is_in(run, part, record.image)) {
            values.push_back(measure.value(record));
        }
    }
    if (values.empty()) {
        throw std::invalid_argument(fmt::format("method '{}' did not take part", method));
    }
    return values;
}

}  // namespace

double area_weighted_l1(const Record& record) {
    double residual = 0;
    double light = 0;
    double area = 1;
    for (const BandRecord& band : record.bands) {
        residual += area * band.residual_l1;
        light += area * band.light_l1;
        area /= 4;
    }
    if (light == 0) {
        return residual == 0 ? 0 : 1;
    }
    return residual / light;
}

double mean_of(const LightRun& run, const std::string& method, Measure measure) {
    double sum = 0;
    const std::vector<double> values = values_of(run, method, measure, Part::moving);
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

double ratio_of_means(const LightRun& run,
                      const std::string& method,
                      const std::string& other,
                      Measure measure) {
    return mean_of(run, method, measure) / mean_of(run, other, measure);
}

double share_no_worse(const LightRun& run,
                      const std::string& method,
                      const std::string& other,
                      Measure measure,
                      Part part) {
    const std::vector<double> own = values_of(run, method, measure, part);
    const std::vector<double> others = values_of(run, other, measure, part);
    double count = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        count += own[i] <= others[i] ? 1 : 0;
    }
    return count / static_cast<double>(own.size());
}

double at_rest(const LightRun& run,
               const std::string& method,
               std::uint32_t images,
               Measure measure) {
    return values_of(run, method, measure, Part::whole).at(run.rests_from + images);
}

std::optional<double> nwa_terms_at(const LightRun& run, double error, Measure measure) {
    double fewer = 0;
    double error_of_fewer = 0;
    for (const std::uint32_t terms : Evidence::kTermsOfNwa) {
        const double error_here = mean_of(run, fmt::format("nwa-{}-area", terms), measure);
        if (error_here <= error) {
            if (fewer == 0) {
                return terms;
            }
            const double way = std::log(error_of_fewer / error) /
                               std::log(error_of_fewer / std::max(error_here, 1e-30));
            return fewer * std::pow(terms / fewer, way);
        }
        fewer = terms;
        error_of_fewer = error_here;
    }
    return std::nullopt;
}

}  // namespace relume::lab
