#include "protocol/transport/cell_cost.h"

#include <algorithm>
#include <limits>

namespace relume::transport {
namespace {

// A cell of strips: so much, and so much for every strip.
constexpr double kStripsNs = 4;
constexpr double kStripNs = 3.8;
constexpr double kDense8Ns = 45;
constexpr double kDense16Ns = 94;
constexpr double kFloatsNs = 124;

template <typename T>
bool in_range(const CellShape& shape) {
    return shape.least >= std::numeric_limits<T>::min() &&
           shape.largest <= std::numeric_limits<T>::max();
}

std::size_t strips_bytes(const CellShape::Occupancy& occupancy) {
    return 1 + 2 * occupancy.strips + occupancy.nonzeros;
}

double strips_ns(const CellShape::Occupancy& occupancy) {
    return kStripsNs + kStripNs * static_cast<double>(occupancy.strips);
}

// The low part of a split cell as a cell of its own.
CellShape low_part(const CellShape& shape) {
    return {.all = shape.low, .low = shape.low, .high = {}};
}

void add_strip(unsigned nonzeros, CellShape::Occupancy& occupancy) {
    occupancy.nonzeros += nonzeros;
    occupancy.strips += nonzeros > 0 ? 1U : 0U;
}

}  // namespace

CellShape CellShape::of(const QuantisedCell& values) {
    CellShape shape;
    for (std::size_t first = 0; first < kBlockSize; first += kStripSlots) {
        unsigned all = 0;
        unsigned low = 0;
        unsigned high = 0;
        for (std::size_t slot = first; slot < first + kStripSlots; ++slot) {
            const std::int32_t value = values[slot];
            const std::int32_t low_value = static_cast<std::int8_t>(value & 0xFF);
            all += value != 0 ? 1U : 0U;
            low += low_value != 0 ? 1U : 0U;
            high += value != low_value ? 1U : 0U;
            shape.least = std::min(shape.least, value);
            shape.largest = std::max(shape.largest, value);
        }
        add_strip(all, shape.all);
        add_strip(low, shape.low);
        add_strip(high, shape.high);
    }
    return shape;
}

bool CellShape::fits(CellTag tag) const {
    if (is_split(tag)) {
        // The largest low part is 127, the largest high part 127·256.
        constexpr std::int32_t kLargestSplit = 127 + kHighPart * 127;
        return in_range<std::int16_t>(*this) && largest <= kLargestSplit && high.nonzeros > 0 &&
               low.nonzeros > 0;
    }
    switch (tag) {
        case CellTag::empty:
            return all.nonzeros == 0;
        case CellTag::dense8:
        case CellTag::strips8:
            return all.nonzeros > 0 && in_range<std::int8_t>(*this);
        case CellTag::dense16:
            return all.nonzeros > 0 && in_range<std::int16_t>(*this);
        default:
            return all.nonzeros > 0;  // floats
    }
}

std::size_t CellShape::bytes(CellTag tag) const {
    if (is_split(tag)) {
        return strips_bytes(high) + low_part(*this).bytes(low_tag(tag));
    }
    switch (tag) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return kBlockSize;
        case CellTag::strips8:
            return strips_bytes(all);
        case CellTag::dense16:
            return kBlockSize * sizeof(std::int16_t);
        default:
            return kBlockSize * sizeof(float);
    }
}

double CellShape::nanoseconds(CellTag tag) const {
    if (is_split(tag)) {
        return strips_ns(high) + low_part(*this).nanoseconds(low_tag(tag));
    }
    switch (tag) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return kDense8Ns;
        case CellTag::strips8:
            return strips_ns(all);
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
    CellTag best = all.nonzeros == 0 ? CellTag::empty : CellTag::dense32f;
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        const auto tag = static_cast<CellTag>(i);
        if (fits(tag) && cost(tag) < cost(best)) {
            best = tag;
        }
    }
    return best;
}

}  // namespace relume::transport
