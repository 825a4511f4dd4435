#include "protocol/brdf/direction_table.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/brdf/direction_angles.h"
#include "protocol/brdf/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::brdf {
namespace {

// Angles in units of the grid.
struct Scale {
    float rows_per_radian;
    float columns_per_radian;
    std::int32_t last_row;  // that a cell begins at
    std::int32_t columns;
};

Scale scale_of(const TableShape& shape) {
    constexpr float kHalfPi = std::numbers::pi_v<float> / 2;
    return {static_cast<float>(shape.rows - 1) / kHalfPi,
            static_cast<float>(shape.columns) / (4 * kHalfPi),
            static_cast<std::int32_t>(shape.rows) - 2,
            static_cast<std::int32_t>(shape.columns)};
}

// The cell of the grid around a direction, and how its four corners weigh.
struct Cell {
    std::int32_t row;
    std::int32_t left;
    std::int32_t right;
    std::array<float, 4> weights;  // upper left, upper right, lower left, lower right
};

// Comparisons are written so that what is no number ends at 0.
inline float at_most(float value, float largest) {
    const float not_negative = value > 0 ? value : 0;
    return not_negative < largest ? not_negative : largest;
}

inline Cell cell_around(float x, float y, float z, const Scale& scale) {
    const float row = at_most(polar_angle(x, y, z > 0 ? z : 0) * scale.rows_per_radian,
                              static_cast<float>(scale.last_row + 1));
    const float column = at_most(azimuthal_angle(x, y) * scale.columns_per_radian,
                                 static_cast<float>(scale.columns));
    const auto whole_row = static_cast<std::int32_t>(row);
    const auto whole_column = static_cast<std::int32_t>(column);
    const std::int32_t upper = whole_row < scale.last_row ? whole_row : scale.last_row;
    const float down = row - static_cast<float>(upper);
    const float across = column - static_cast<float>(whole_column);
    const std::int32_t left = whole_column < scale.columns ? whole_column : 0;
    const std::int32_t right = left + 1 < scale.columns ? left + 1 : 0;
    const float seen = z > 0 ? 1.0F : 0.0F;
    const float above = seen * (1 - down);
    const float below = seen * down;
    return {upper,
            left,
            right,
            {above * (1 - across), above * across, below * (1 - across), below * across}};
}

// out[d] = the cell's value of every function.
inline void blend(const float* values,
                  const TableShape& shape,
                  const Cell& cell,
                  float* __restrict out) {
    const std::size_t depth = shape.depth;
    const std::size_t row = static_cast<std::size_t>(cell.row) * shape.columns;
    const std::size_t left = static_cast<std::size_t>(cell.left);
    const std::size_t right = static_cast<std::size_t>(cell.right);
    const float* a = values + (row + left) * depth;
    const float* b = values + (row + right) * depth;
    const float* c = values + (row + shape.columns + left) * depth;
    const float* d = values + (row + shape.columns + right) * depth;
    for (std::size_t i = 0; i < depth; ++i) {
        out[i] = (cell.weights[0] * a[i] + cell.weights[1] * b[i]) +
                 (cell.weights[2] * c[i] + cell.weights[3] * d[i]);
    }
}

constexpr std::size_t kChunk = 64;

// The cells of a chunk of directions, in planes so that finding them vectorises.
struct CellPlanes {
    std::array<std::int32_t, kChunk> row, left, right;
    std::array<std::array<float, kChunk>, 4> weights;
};

RELUME_CPU_CLONES void find_cells(const float* x,
                                  const float* y,
                                  const float* z,
                                  const Scale& given,
                                  CellPlanes& __restrict cells,
                                  std::size_t count) {
    const Scale scale = given;
    for (std::size_t i = 0; i < count; ++i) {
        const Cell cell = cell_around(x[i], y[i], z[i], scale);
        cells.row[i] = cell.row;
        cells.left[i] = cell.left;
        cells.right[i] = cell.right;
        cells.weights[0][i] = cell.weights[0];
        cells.weights[1][i] = cell.weights[1];
        cells.weights[2][i] = cell.weights[2];
        cells.weights[3][i] = cell.weights[3];
    }
}

RELUME_CPU_CLONES void blend_cells(const float* values,
                                   const TableShape& shape,
                                   const CellPlanes& cells,
                                   float* __restrict out,
                                   std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const Cell cell{cells.row[i],
                        cells.left[i],
                        cells.right[i],
                        {cells.weights[0][i], cells.weights[1][i], cells.weights[2][i],
                         cells.weights[3][i]}};
        blend(values, shape, cell, out + i * shape.depth);
    }
}

}  // namespace

bool TableShape::is_valid() const {
    return rows >= kLeastRows && rows <= kMostRows && columns >= 1 && columns <= kMostColumns &&
           depth >= 1 && depth <= kMostDepth;
}

std::size_t TableShape::value_count() const {
    return std::size_t{rows} * columns * depth;
}

double TableShape::theta_from_row(std::uint32_t row) const {
    return row * (std::numbers::pi / 2) / (rows - 1);
}

double TableShape::phi_from_column(std::uint32_t column) const {
    return column * (2 * std::numbers::pi) / columns;
}

DirectionTable::DirectionTable() : values_(shape_.value_count(), 0.0F) {}

DirectionTable::DirectionTable(const TableShape& shape, std::vector<float> values)
    : shape_(shape), values_(std::move(values)) {
    if (!shape.is_valid()) {
        throw BrdfError(fmt::format(
            "a table of {} rows, {} columns, depth {}: expected {} … {}, 1 … {}, 1 … {}",
            shape.rows, shape.columns, shape.depth, TableShape::kLeastRows,
            TableShape::kMostRows, TableShape::kMostColumns, TableShape::kMostDepth));
    }
    if (values_.size() != shape.value_count()) {
        throw BrdfError(fmt::format(
            "a table of {} rows, {} columns, depth {} has {} values, "
            "expected {}",
            shape.rows, shape.columns, shape.depth, values_.size(), shape.value_count()));
    }
    const auto bad = std::find_if(values_.begin(), values_.end(),
                                  [](float value) { return !std::isfinite(value); });
    if (bad != values_.end()) {
        throw BrdfError(fmt::format("value {} of a table is {}, expected a finite number",
                                    bad - values_.begin(), *bad));
    }
}

void DirectionTable::evaluate(const Imath::V3f& local, std::span<float> out) const {
    blend(values_.data(), shape_, cell_around(local.x, local.y, local.z, scale_of(shape_)),
          out.data());
}

void DirectionTable::evaluate(const Directions& local, std::span<float> out) const {
    const Scale scale = scale_of(shape_);
    CellPlanes cells;
    for (std::size_t start = 0; start < local.size(); start += kChunk) {
        const std::size_t count = std::min(kChunk, local.size() - start);
        find_cells(local.x.data() + start, local.y.data() + start, local.z.data() + start,
                   scale, cells, count);
        blend_cells(values_.data(), shape_, cells, out.data() + start * shape_.depth, count);
    }
}

}  // namespace relume::brdf
