// What a cell holds, strip by strip, for those who arrange it anew.
#pragma once

#include "protocol/transport/cell.h"
#include "protocol/transport/cell_cost.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace relume::transport {

using StripValues = std::array<std::int8_t, kStripSlots>;
using FloatStripValues = std::array<float, kStripSlots>;

namespace detail {

// Returns the end of the cell.
template <typename Visit>
const std::uint8_t* visit_strips8(const std::uint8_t* cell,
                                  std::size_t part,
                                  const Visit& visit) {
    const std::size_t count = cell[0];
    const std::uint8_t* packed = cell + 1 + 2 * count;
    for (std::size_t i = 0; i < count; ++i) {
        StripValues values{};
        for (unsigned mask = cell[2 + 2 * i]; mask != 0; mask &= mask - 1) {
            values[static_cast<std::size_t>(std::countr_zero(mask))] =
                static_cast<std::int8_t>(*packed++);
        }
        visit(part, std::size_t{cell[1 + 2 * i]}, values);
    }
    return packed;
}

template <typename Visit>
void visit_dense8(const std::uint8_t* cell, const Visit& visit) {
    for (std::size_t strip = 0; strip < kStripsPerBlock; ++strip) {
        StripValues values;
        std::memcpy(values.data(), cell + strip * kStripSlots, kStripSlots);
        if (values != StripValues{}) {
            visit(std::size_t{0}, strip, values);
        }
    }
}

template <typename Visit>
void visit_dense16(const std::uint8_t* cell, const Visit& visit) {
    std::array<std::int16_t, kBlockSize> all;
    std::memcpy(all.data(), cell, sizeof(all));
    for (std::size_t strip = 0; strip < kStripsPerBlock; ++strip) {
        std::array<StripValues, kMaxParts> parts;
        for (std::size_t i = 0; i < kStripSlots; ++i) {
            const auto of_value = parts_of(all[strip * kStripSlots + i]);
            for (std::size_t part = 0; part < kMaxParts; ++part) {
                parts[part][i] = static_cast<std::int8_t>(of_value[part]);
            }
        }
        for (std::size_t part = kMaxParts; part-- > 0;) {
            if (parts[part] != StripValues{}) {
                visit(part, strip, parts[part]);
            }
        }
    }
}

template <typename Visit>
void visit_floats(const std::uint8_t* cell, const Visit& visit) {
    for (std::size_t strip = 0; strip < kStripsPerBlock; ++strip) {
        FloatStripValues values;
        std::memcpy(values.data(), cell + strip * sizeof(values), sizeof(values));
        if (values != FloatStripValues{}) {
            visit(std::size_t{0}, strip, values);
        }
    }
}

}  // namespace detail

// Calls visit(part, strip, values) for the strips of a validated cell in which anything is: the
// cell is Σ 256^part·values, values being StripValues, or FloatStripValues of a dense32f cell.
template <typename Visit>
void for_each_strip(CellTag tag, const std::uint8_t* cell, const Visit& visit) {
    for (std::size_t part = upper_parts(tag); part > 0; --part) {
        cell = detail::visit_strips8(cell, part, visit);
    }
    switch (low_tag(tag)) {
        case CellTag::strips8:
            detail::visit_strips8(cell, 0, visit);
            break;
        case CellTag::dense8:
            detail::visit_dense8(cell, visit);
            break;
        case CellTag::dense16:
            detail::visit_dense16(cell, visit);
            break;
        case CellTag::dense32f:
            detail::visit_floats(cell, visit);
            break;
        default:  // empty
            break;
    }
}

}  // namespace relume::transport
