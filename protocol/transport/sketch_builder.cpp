#include "protocol/transport/sketch_builder.h"

#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::transport {

SketchPlan::SketchPlan(const SketchStrata& strata, std::uint64_t seed)
    : strata_(strata), places_(std::size_t{strata.blocks} * kBlockSize) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
        const std::uint64_t bits = mix_bits(mix_bits(seed) ^ p);
        const std::uint32_t stratum =
            strata.stratum_of_block(static_cast<std::uint32_t>(p / kBlockSize));
        const std::uint64_t row =
            strata.first_row(stratum) + (bits >> 1) % strata.row_count(stratum);
        places_[p] = {.row = static_cast<std::uint16_t>(row),
                      .sign = (bits & 1U) != 0 ? 1.0F : -1.0F};
    }
}

SketchTable SketchPlan::empty_table(std::size_t columns) const {
    return {.strata = strata_,
            .scales = std::vector<float>(columns * kColours),
            .values = std::vector<std::int8_t>(columns * kColours * rows())};
}

ColumnSketch::ColumnSketch(const SketchPlan& plan)
    : plan_(plan), sums_(kColours * std::size_t{plan.rows()}) {}

void ColumnSketch::clear() {
    std::fill(sums_.begin(), sums_.end(), 0.0);
}

void ColumnSketch::add(std::size_t colour, std::size_t receiver, double value) {
    const SketchPlan::Place& place = plan_.places_[receiver];
    sums_[colour * plan_.rows() + place.row] += double{place.sign} * value;
}

void ColumnSketch::store(std::size_t column, SketchTable& table) const {
    constexpr double kLargestInteger = std::numeric_limits<std::int8_t>::max();
    const std::size_t rows = plan_.rows();
    for (std::size_t c = 0; c < kColours; ++c) {
        const std::span<const double> sums = std::span(sums_).subspan(c * rows, rows);
        double largest = 0;
        for (const double value : sums) {
            largest = std::max(largest, std::abs(value));
        }
        const std::size_t place = column * kColours + c;
        const auto scale = static_cast<float>(largest / kLargestInteger);
        table.scales[place] = scale;
        for (std::size_t r = 0; r < rows && scale > 0; ++r) {
            table.values[place * rows + r] = static_cast<std::int8_t>(
                std::clamp(std::round(sums[r] / scale), -kLargestInteger, kLargestInteger));
        }
    }
}

}  // namespace relume::transport
