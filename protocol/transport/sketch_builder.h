// Making a transport's sketch, a column at a time.
#pragma once

#include "protocol/transport/sketch.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

// What a Sketch reads.
struct SketchTable {
    SketchStrata strata;
    std::vector<float> scales;        // [N][3]
    std::vector<std::int8_t> values;  // [N][3][rows]

    [[nodiscard]] Sketch view() const { return {strata, scales, values}; }
};

// A count sketch [Charikar02]: every receiver adds to one of R rows with one sign. So a column
// costs one addition for each value, where a dense matrix of random signs costs R. The estimate
// of ‖T ΔL‖² is unbiased, with a relative variance of at most 2/R, like that of the dense
// matrix. Immutable; safe to share between threads.
class SketchPlan {
  public:
    // Receivers are the 256 slots of every block. Row and sign of a receiver follow from seed,
    // strata and its number alone; seeds that differ give independent ones. At most 65536 rows.
    SketchPlan(const SketchStrata& strata, std::uint64_t seed);

    [[nodiscard]] std::uint32_t rows() const { return strata_.rows; }
    [[nodiscard]] SketchTable empty_table(std::size_t columns) const;

  private:
    friend class ColumnSketch;
    struct Place {
        std::uint16_t row = 0;
        float sign = 1;
    };

    SketchStrata strata_;
    std::vector<Place> places_;
};

// The sketch of one column at a time. Keeps a reference to the plan. Not thread-safe.
class ColumnSketch {
  public:
    explicit ColumnSketch(const SketchPlan& plan);

    void clear();
    // Adds the value of one receiver, tint applied.
    void add(std::size_t colour, std::size_t receiver, double value);
    // Rounds to 8 bits, so that the largest value of each colour becomes the largest integer.
    // That adds noise of a hundredth, where the estimate itself is good to a twentieth.
    void store(std::size_t column, SketchTable& table) const;

  private:
    const SketchPlan& plan_;
    std::vector<double> sums_;  // [3][rows]
};

}  // namespace relume::transport
