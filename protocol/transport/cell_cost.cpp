#include "protocol/transport/cell_cost.h"

#include <algorithm>
#include <limits>

namespace relume::transport {
namespace {

// Sparse cells: so much, and so much for every value.
constexpr double kSparseNs = 15;
constexpr double kSparseValueNs = 1.7;
// However many values there are, as they are spread to all slots.
constexpr double kBitmapNs = 115;
constexpr double kDense8Ns = 44;
constexpr double kDense16Ns = 56;
constexpr double kFloatsNs = 98;

template <typename T>
bool in_range(const CellShape& shape) {
    return shape.least >= std::numeric_limits<T>::min() &&
           shape.largest <= std::numeric_limits<T>::max();
}

std::size_t sparse_bytes(std::size_t nonzeros) {
    return 1 + 2 * nonzeros;
}

double sparse_ns(std::size_t values) {
    return kSparseNs + kSparseValueNs * static_cast<double>(values);
}

// The low part of a split cell as a cell of its own.
CellShape low_part(const CellShape& shape) {
    return {.nonzeros = shape.low_nonzeros, .low_nonzeros = shape.low_nonzeros};
}

}  // namespace

CellShape CellShape::of(const QuantisedCell& values) {
    CellShape shape;
    for (const std::int32_t value : values) {
        const std::int32_t low = static_cast<std::int8_t>(value & 0xFF);
        shape.nonzeros += value != 0 ? 1U : 0U;
        shape.low_nonzeros += low != 0 ? 1U : 0U;
        shape.high_nonzeros += value != low ? 1U : 0U;
        shape.least = std::min(shape.least, value);
        shape.largest = std::max(shape.largest, value);
    }
    return shape;
}

bool CellShape::fits(CellTag tag) const {
    constexpr std::size_t kMostSparse = std::numeric_limits<std::uint8_t>::max();
    if (is_split(tag)) {
        // The largest low part is 127, the largest high part 127·256.
        constexpr std::int32_t kLargestSplit = 127 + kHighPart * 127;
        return in_range<std::int16_t>(*this) && largest <= kLargestSplit && high_nonzeros > 0 &&
               high_nonzeros <= kMostSparse && low_nonzeros > 0 &&
               low_part(*this).fits(low_tag(tag));
    }
    switch (tag) {
        case CellTag::empty:
            return nonzeros == 0;
        case CellTag::dense8:
            return nonzeros > 0 && in_range<std::int8_t>(*this);
        case CellTag::bitmap8:
            return nonzeros > 0 && in_range<std::int8_t>(*this);
        case CellTag::sparse8:
            return nonzeros > 0 && nonzeros <= kMostSparse && in_range<std::int8_t>(*this);
        case CellTag::dense16:
        case CellTag::bitmap16:
            return nonzeros > 0 && in_range<std::int16_t>(*this);
        default:
            return nonzeros > 0;  // floats
    }
}

std::size_t CellShape::bytes(CellTag tag) const {
    if (is_split(tag)) {
        return sparse_bytes(high_nonzeros) + low_part(*this).bytes(low_tag(tag));
    }
    switch (tag) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return kBlockSize;
        case CellTag::bitmap8:
            return kBitmapBytes + nonzeros;
        case CellTag::sparse8:
            return sparse_bytes(nonzeros);
        case CellTag::dense16:
            return kBlockSize * sizeof(std::int16_t);
        case CellTag::bitmap16:
            return kBitmapBytes + sizeof(std::int16_t) * nonzeros;
        default:
            return kBlockSize * sizeof(float);
    }
}

double CellShape::nanoseconds(CellTag tag) const {
    if (is_split(tag)) {
        return sparse_ns(high_nonzeros) + low_part(*this).nanoseconds(low_tag(tag));
    }
    switch (tag) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return kDense8Ns;
        case CellTag::sparse8:
            return sparse_ns(nonzeros);
        case CellTag::bitmap8:
        case CellTag::bitmap16:
            return kBitmapNs;
        case CellTag::dense16:
            return kDense16Ns;
        default:
            return kFloatsNs;
    }
}

double CellShape::cost(CellTag tag) const {
    return nanoseconds(tag) + kNanosecondsPerByte * static_cast<double>(bytes(tag));
}

CellTag CellShape::cheapest() const {
    CellTag best = nonzeros == 0 ? CellTag::empty : CellTag::dense32f;
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        const auto tag = static_cast<CellTag>(i);
        if (fits(tag) && cost(tag) < cost(best)) {
            best = tag;
        }
    }
    return best;
}

}  // namespace relume::transport
