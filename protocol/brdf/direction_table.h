// Functions over the upper hemisphere of a local frame, as values on a grid of angles: `rows`
// of θ_i = i/(rows − 1)·π/2 from the normal and `columns` of φ_j = 2πj/columns from tangent to
// bitangent. Between them values are bilinear, and periodic in φ; with one column they depend
// on θ alone. A direction that is not above the horizon (z ≤ 0) has the value 0.
//
// A table holds `depth` functions of one grid, which are looked up together: value d of row i
// and column j is values()[(i·columns + j)·depth + d]. Const members are thread-safe.
#pragma once

#include "protocol/brdf/directions.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::brdf {

struct TableShape {
    static constexpr std::uint32_t kLeastRows = 2;
    static constexpr std::uint32_t kMostRows = 512;
    static constexpr std::uint32_t kMostColumns = 1024;
    static constexpr std::uint32_t kMostDepth = 64;

    std::uint32_t rows = kLeastRows;
    std::uint32_t columns = 1;
    std::uint32_t depth = 1;

    // In range, each of them.
    [[nodiscard]] bool is_valid() const;
    [[nodiscard]] std::size_t value_count() const;
    // In radians.
    [[nodiscard]] double theta_from_row(std::uint32_t row) const;
    [[nodiscard]] double phi_from_column(std::uint32_t column) const;
    [[nodiscard]] bool operator==(const TableShape&) const = default;
};

class DirectionTable {
  public:
    // Two rows, one column, one function: 0.
    DirectionTable();
    // Throws BrdfError for a shape out of range, a wrong number of values, one not finite.
    DirectionTable(const TableShape& shape, std::vector<float> values);

    [[nodiscard]] const TableShape& shape() const { return shape_; }
    [[nodiscard]] std::span<const float> values() const { return values_; }

    // The specification: out[d], `depth` of them, towards `local`, which may have any length. A
    // direction with a coordinate that is not finite has finite values, whichever.
    void evaluate(const Imath::V3f& local, std::span<float> out) const;
    // The same for many directions, with the same bits: out[i·depth + d].
    void evaluate(const Directions& local, std::span<float> out) const;

  private:
    TableShape shape_;
    std::vector<float> values_;
};

}  // namespace relume::brdf
