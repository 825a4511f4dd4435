#include "protocol/transport/cell.h"

#include "protocol/transport/cell_cost.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace relume::transport {
namespace {

static_assert(std::endian::native == std::endian::little,
              "cells are stored little-endian and read in place");

template <typename T>
void append_value(std::vector<std::uint8_t>& bytes, T value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(&bytes[at], &value, sizeof(T));
}

template <typename T>
T read_value(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

template <typename T>
void append_all(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    for (const std::int32_t value : values) {
        append_value(bytes, static_cast<T>(value));
    }
}

void append_strips8(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    const std::size_t count = bytes.size();
    bytes.push_back(0);
    for (std::size_t strip = 0; strip < kStripsPerBlock; ++strip) {
        unsigned mask = 0;
        for (std::size_t i = 0; i < kStripSlots; ++i) {
            mask |= (values[strip * kStripSlots + i] != 0 ? 1U : 0U) << i;
        }
        if (mask != 0) {
            bytes.push_back(static_cast<std::uint8_t>(strip));
            bytes.push_back(static_cast<std::uint8_t>(mask));
            ++bytes[count];
        }
    }
    for (const std::int32_t value : values) {
        if (value != 0) {
            append_value(bytes, static_cast<std::int8_t>(value));
        }
    }
}

// Part i of all values.
QuantisedCell part_of(const QuantisedCell& values, std::size_t i) {
    QuantisedCell part;
    std::transform(values.begin(), values.end(), part.begin(),
                   [i](std::int32_t value) { return parts_of(value)[i]; });
    return part;
}

// Values a cell of strips holds.
std::size_t strips8_values(const std::uint8_t* cell) {
    std::size_t values = 0;
    for (std::size_t i = 0; i < cell[0]; ++i) {
        values += static_cast<std::size_t>(std::popcount(cell[2 + 2 * i]));
    }
    return values;
}

std::size_t strips8_bytes(const std::uint8_t* cell) {
    return 1 + 2 * std::size_t{cell[0]} + strips8_values(cell);
}

template <typename T>
const std::uint8_t* decode_dense(const std::uint8_t* cell, DecodedCell& values) {
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] = static_cast<float>(read_value<T>(cell + slot * sizeof(T)));
    }
    return cell + kBlockSize * sizeof(T);
}

const std::uint8_t* decode_strips8(const std::uint8_t* cell, DecodedCell& values) {
    const std::size_t count = cell[0];
    const std::uint8_t* packed = cell + 1 + 2 * count;
    values.fill(0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = kStripSlots * cell[1 + 2 * i];
        for (unsigned mask = cell[2 + 2 * i]; mask != 0; mask &= mask - 1) {
            values[first + static_cast<std::size_t>(std::countr_zero(mask))] =
                static_cast<float>(static_cast<std::int8_t>(*packed++));
        }
    }
    return packed;
}

const std::uint8_t* decode_split(CellTag tag, const std::uint8_t* cell, DecodedCell& values) {
    DecodedCell upper{};
    for (std::size_t i = upper_parts(tag); i > 0; --i) {
        DecodedCell part;
        cell = decode_strips8(cell, part);
        for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
            upper[slot] = kPartBase * (upper[slot] + part[slot]);
        }
    }
    cell = decode_cell(low_tag(tag), cell, values);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] += upper[slot];
    }
    return cell;
}

// `count` strips, ascending, none empty.
void check_strips(const std::uint8_t* cell, std::size_t count) {
    int last = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const int strip = cell[1 + 2 * i];
        if (strip <= last || strip >= static_cast<int>(kStripsPerBlock)) {
            throw TransportError(fmt::format(
                "strip {} follows strip {} in a cell, expected ascending strips below {}",
                strip, last, kStripsPerBlock));
        }
        if (cell[2 + 2 * i] == 0) {
            throw TransportError(fmt::format("strip {} of a cell holds nothing", strip));
        }
        last = strip;
    }
}

void check_finite(const std::uint8_t* cell) {
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if (!std::isfinite(read_value<float>(cell + slot * sizeof(float)))) {
            throw TransportError(
                fmt::format("value {} of a float cell is not a finite number", slot));
        }
    }
}

}  // namespace

CellTag append_cell(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    const CellTag tag = CellShape::of(values).cheapest();
    append_cell_as(tag, values, bytes);
    return tag;
}

void append_cell_as(CellTag tag,
                    const QuantisedCell& values,
                    std::vector<std::uint8_t>& bytes) {
    for (std::size_t i = upper_parts(tag); i > 0; --i) {
        append_strips8(part_of(values, i), bytes);
    }
    if (upper_parts(tag) > 0) {
        append_cell_as(low_tag(tag), part_of(values, 0), bytes);
        return;
    }
    switch (tag) {
        case CellTag::empty:
            return;
        case CellTag::dense8:
            append_all<std::int8_t>(values, bytes);
            return;
        case CellTag::strips8:
            append_strips8(values, bytes);
            return;
        case CellTag::dense16:
            append_all<std::int16_t>(values, bytes);
            return;
        case CellTag::dense32f:
            append_all<float>(values, bytes);
            return;
        default:
            return;
    }
}

std::size_t validated_cell_bytes(std::uint8_t tag, std::span<const std::uint8_t> bytes) {
    if (tag >= kCellTagCount) {
        throw TransportError(
            fmt::format("unknown cell tag {}, expected 0 to {}", tag, kCellTagCount - 1));
    }
    const auto cell_tag = static_cast<CellTag>(tag);
    if (upper_parts(cell_tag) > 0) {
        std::size_t size = 0;
        for (std::size_t i = upper_parts(cell_tag); i > 0; --i) {
            size += validated_cell_bytes(static_cast<std::uint8_t>(CellTag::strips8),
                                         bytes.subspan(size));
        }
        return size + validated_cell_bytes(static_cast<std::uint8_t>(low_tag(cell_tag)),
                                           bytes.subspan(size));
    }
    const auto require = [&](std::size_t needed) {
        if (bytes.size() < needed) {
            throw TransportError(fmt::format("{} cell needs {} bytes, {} are left",
                                             kCellTagNames[tag], needed, bytes.size()));
        }
    };
    if (cell_tag == CellTag::strips8) {
        require(1);
        if (bytes[0] == 0) {
            throw TransportError("cell of 0 strips, expected an empty cell");
        }
        require(1 + 2 * std::size_t{bytes[0]});
        check_strips(bytes.data(), bytes[0]);
    }
    const std::size_t size = cell_bytes(cell_tag, bytes.data());
    require(size);
    if (cell_tag == CellTag::dense32f) {
        check_finite(bytes.data());
    }
    return size;
}

std::size_t cell_bytes(CellTag tag, const std::uint8_t* cell) {
    std::size_t upper = 0;
    for (std::size_t i = upper_parts(tag); i > 0; --i) {
        upper += strips8_bytes(cell + upper);
    }
    switch (low_tag(tag)) {
        case CellTag::dense8:
            return upper + kBlockSize;
        case CellTag::strips8:
            return upper + strips8_bytes(cell + upper);
        case CellTag::dense16:
            return kBlockSize * sizeof(std::int16_t);
        case CellTag::dense32f:
            return kBlockSize * sizeof(float);
        default:
            return 0;
    }
}

const std::uint8_t* decode_cell(CellTag tag, const std::uint8_t* cell, DecodedCell& values) {
    switch (tag) {
        case CellTag::empty:
            values.fill(0);
            return cell;
        case CellTag::dense8:
            return decode_dense<std::int8_t>(cell, values);
        case CellTag::strips8:
            return decode_strips8(cell, values);
        case CellTag::dense16:
            return decode_dense<std::int16_t>(cell, values);
        case CellTag::dense32f:
            return decode_dense<float>(cell, values);
        default:
            return decode_split(tag, cell, values);
    }
}

std::uint64_t SegmentView::occupied_blocks(std::uint32_t block_count) const {
    constexpr std::uint32_t kTagsPerWord = 16;
    std::uint64_t blocks = 0;
    for (std::uint32_t first = 0; first < block_count; first += kTagsPerWord) {
        std::uint64_t word = 0;
        std::memcpy(&word, tags + first / 2,
                    tag_bytes(std::min(kTagsPerWord, block_count - first)));
        // Every fourth bit, closed up.
        word = occupied_tags(word);
        word = (word | word >> 3U) & 0x0303'0303'0303'0303U;
        word = (word | word >> 6U) & 0x000F'000F'000F'000FU;
        word = (word | word >> 12U) & 0x0000'00FF'0000'00FFU;
        word = (word | word >> 24U) & 0xFFFFU;
        blocks |= word << first;
    }
    return blocks;
}

std::uint32_t cell_nonzeros(CellTag tag, const std::uint8_t* cell) {
    if (tag == CellTag::strips8) {
        return static_cast<std::uint32_t>(strips8_values(cell));
    }
    DecodedCell values;
    decode_cell(tag, cell, values);
    return static_cast<std::uint32_t>(
        std::count_if(values.begin(), values.end(), [](float value) { return value != 0; }));
}

}  // namespace relume::transport
