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

void add_strip(unsigned nonzeros, CellShape::Occupancy& occupancy) {
    occupancy.nonzeros += nonzeros;
    occupancy.strips += nonzeros > 0 ? 1U : 0U;
}

// The value whose lowest `count` parts are all this one.
constexpr std::int32_t value_of(std::int8_t part, std::size_t count) {
    std::int32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value = value * kPartBase + part;
    }
    return value;
}

}  // namespace

CellParts parts_of(std::int32_t value) {
    CellParts parts{};
    for (std::int32_t& part : parts) {
        part = static_cast<std::int8_t>(value & 0xFF);
        value = (value - part) / kPartBase;
    }
    return parts;
}

CellShape CellShape::of(const QuantisedCell& values) {
    CellShape shape;
    for (std::size_t first = 0; first < kBlockSize; first += kStripSlots) {
        unsigned all = 0;
        std::array<unsigned, kMaxParts> nonzeros{};
        for (std::size_t slot = first; slot < first + kStripSlots; ++slot) {
            const std::int32_t value = values[slot];
            const CellParts parts = parts_of(value);
            all += value != 0 ? 1U : 0U;
            for (std::size_t i = 0; i < kMaxParts; ++i) {
                nonzeros[i] += parts[i] != 0 ? 1U : 0U;
            }
            shape.least = std::min(shape.least, value);
            shape.largest = std::max(shape.largest, value);
        }
        add_strip(all, shape.all);
        for (std::size_t i = 0; i < kMaxParts; ++i) {
            add_strip(nonzeros[i], shape.parts[i]);
        }
    }
    return shape;
}

bool CellShape::fits(CellTag tag) const {
    if (tag == CellTag::empty || all.nonzeros == 0) {
        return tag == CellTag::empty && all.nonzeros == 0;
    }
    switch (low_tag(tag)) {
        case CellTag::dense16:
            return in_range<std::int16_t>(*this);
        case CellTag::dense32f:
            return true;
        default:
            break;
    }
    const std::size_t count = 1 + upper_parts(tag);
    using Part = std::numeric_limits<std::int8_t>;
    return least >= value_of(Part::min(), count) && largest <= value_of(Part::max(), count) &&
           std::all_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                       [](const Occupancy& part) { return part.nonzeros > 0; });
}

std::size_t CellShape::bytes(CellTag tag) const {
    std::size_t upper = 0;
    for (std::size_t i = upper_parts(tag); i > 0; --i) {
        upper += strips_bytes(parts[i]);
    }
    switch (low_tag(tag)) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return upper + kBlockSize;
        case CellTag::strips8:
            return upper + strips_bytes(parts[0]);
        case CellTag::dense16:
            return kBlockSize * sizeof(std::int16_t);
        default:
            return kBlockSize * sizeof(float);
    }
}

double CellShape::nanoseconds(CellTag tag) const {
    double upper = 0;
    for (std::size_t i = upper_parts(tag); i > 0; --i) {
        upper += strips_ns(parts[i]);
    }
    switch (low_tag(tag)) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return upper + kDense8Ns;
        case CellTag::strips8:
            return upper + strips_ns(parts[0]);
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
