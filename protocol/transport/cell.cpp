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

void append_bitmap(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    const std::size_t at = bytes.size();
    bytes.resize(at + kBitmapBytes, 0);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if (values[slot] != 0) {
            bytes[at + slot / 8] =
                static_cast<std::uint8_t>(bytes[at + slot / 8] | (1U << (slot % 8)));
        }
    }
}

template <typename T>
void append_all(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    for (const std::int32_t value : values) {
        append_value(bytes, static_cast<T>(value));
    }
}

template <typename T>
void append_nonzero(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    for (const std::int32_t value : values) {
        if (value != 0) {
            append_value(bytes, static_cast<T>(value));
        }
    }
}

void append_sparse8(const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    const std::size_t count = bytes.size();
    bytes.push_back(0);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if (values[slot] != 0) {
            bytes.push_back(static_cast<std::uint8_t>(slot));
        }
    }
    bytes[count] = static_cast<std::uint8_t>(bytes.size() - count - 1);
    append_nonzero<std::int8_t>(values, bytes);
}

// q = low + 256·high with low in 8 bits.
void append_split(CellTag tag, const QuantisedCell& values, std::vector<std::uint8_t>& bytes) {
    QuantisedCell low;
    QuantisedCell high;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        low[slot] = static_cast<std::int8_t>(values[slot] & 0xFF);
        high[slot] = (values[slot] - low[slot]) / kHighPart;
    }
    append_sparse8(high, bytes);
    append_cell_as(low_tag(tag), low, bytes);
}

std::size_t sparse8_bytes(const std::uint8_t* cell) {
    return 1 + 2 * std::size_t{cell[0]};
}

std::uint32_t bitmap_population(const std::uint8_t* bitmap) {
    int population = 0;
    for (std::size_t i = 0; i < kBitmapBytes; i += sizeof(std::uint64_t)) {
        population += std::popcount(read_value<std::uint64_t>(bitmap + i));
    }
    return static_cast<std::uint32_t>(population);
}

template <typename T>
const std::uint8_t* decode_bitmap(const std::uint8_t* cell, DecodedCell& values) {
    const std::uint8_t* packed = cell + kBitmapBytes;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if ((cell[slot / 8] >> (slot % 8)) & 1U) {
            values[slot] = static_cast<float>(read_value<T>(packed));
            packed += sizeof(T);
        } else {
            values[slot] = 0;
        }
    }
    return packed;
}

template <typename T>
const std::uint8_t* decode_dense(const std::uint8_t* cell, DecodedCell& values) {
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] = static_cast<float>(read_value<T>(cell + slot * sizeof(T)));
    }
    return cell + kBlockSize * sizeof(T);
}

const std::uint8_t* decode_sparse8(const std::uint8_t* cell, DecodedCell& values) {
    const std::size_t count = cell[0];
    values.fill(0);
    for (std::size_t i = 0; i < count; ++i) {
        values[cell[1 + i]] = static_cast<float>(static_cast<std::int8_t>(cell[1 + count + i]));
    }
    return cell + sparse8_bytes(cell);
}

const std::uint8_t* decode_split(CellTag tag, const std::uint8_t* cell, DecodedCell& values) {
    DecodedCell high;
    const std::uint8_t* end = decode_cell(low_tag(tag), decode_sparse8(cell, high), values);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] += kHighPart * high[slot];
    }
    return end;
}

void check_sparse_slots(const std::uint8_t* cell, std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) {
        if (cell[1 + i] <= cell[i]) {
            throw TransportError(
                fmt::format("slot {} follows slot {} in a sparse cell, expected "
                            "ascending slots",
                            cell[1 + i], cell[i]));
        }
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
    switch (tag) {
        case CellTag::empty:
            return;
        case CellTag::dense8:
            append_all<std::int8_t>(values, bytes);
            return;
        case CellTag::bitmap8:
            append_bitmap(values, bytes);
            append_nonzero<std::int8_t>(values, bytes);
            return;
        case CellTag::sparse8:
            append_sparse8(values, bytes);
            return;
        case CellTag::dense16:
            append_all<std::int16_t>(values, bytes);
            return;
        case CellTag::bitmap16:
            append_bitmap(values, bytes);
            append_nonzero<std::int16_t>(values, bytes);
            return;
        case CellTag::dense32f:
            append_all<float>(values, bytes);
            return;
        case CellTag::split_dense8:
        case CellTag::split_bitmap8:
        case CellTag::split_sparse8:
            append_split(tag, values, bytes);
            return;
    }
}

std::size_t validated_cell_bytes(std::uint8_t tag, std::span<const std::uint8_t> bytes) {
    if (tag >= kCellTagCount) {
        throw TransportError(
            fmt::format("unknown cell tag {}, expected 0 to {}", tag, kCellTagCount - 1));
    }
    const auto cell_tag = static_cast<CellTag>(tag);
    if (is_split(cell_tag)) {
        const std::size_t high =
            validated_cell_bytes(static_cast<std::uint8_t>(CellTag::sparse8), bytes);
        return high + validated_cell_bytes(static_cast<std::uint8_t>(low_tag(cell_tag)),
                                           bytes.subspan(high));
    }
    const auto require = [&](std::size_t needed) {
        if (bytes.size() < needed) {
            throw TransportError(fmt::format("{} cell needs {} bytes, {} are left",
                                             kCellTagNames[tag], needed, bytes.size()));
        }
    };
    if (cell_tag == CellTag::bitmap8 || cell_tag == CellTag::bitmap16) {
        require(kBitmapBytes);
        if (bitmap_population(bytes.data()) == 0) {
            throw TransportError("bitmap cell without a set bit, expected an empty cell");
        }
    } else if (cell_tag == CellTag::sparse8) {
        require(1);
        if (bytes[0] == 0) {
            throw TransportError("sparse cell of 0 values, expected an empty cell");
        }
    }
    const std::size_t size = cell_bytes(cell_tag, bytes.data());
    require(size);
    if (cell_tag == CellTag::sparse8) {
        check_sparse_slots(bytes.data(), bytes[0]);
    } else if (cell_tag == CellTag::dense32f) {
        check_finite(bytes.data());
    }
    return size;
}

std::size_t cell_bytes(CellTag tag, const std::uint8_t* cell) {
    switch (tag) {
        case CellTag::empty:
            return 0;
        case CellTag::dense8:
            return kBlockSize;
        case CellTag::bitmap8:
            return kBitmapBytes + bitmap_population(cell);
        case CellTag::sparse8:
            return sparse8_bytes(cell);
        case CellTag::dense16:
            return kBlockSize * sizeof(std::int16_t);
        case CellTag::bitmap16:
            return kBitmapBytes + sizeof(std::int16_t) * bitmap_population(cell);
        case CellTag::dense32f:
            return kBlockSize * sizeof(float);
        case CellTag::split_dense8:
        case CellTag::split_bitmap8:
        case CellTag::split_sparse8:
            return sparse8_bytes(cell) + cell_bytes(low_tag(tag), cell + sparse8_bytes(cell));
    }
    return 0;
}

const std::uint8_t* decode_cell(CellTag tag, const std::uint8_t* cell, DecodedCell& values) {
    switch (tag) {
        case CellTag::empty:
            values.fill(0);
            return cell;
        case CellTag::dense8:
            return decode_dense<std::int8_t>(cell, values);
        case CellTag::bitmap8:
            return decode_bitmap<std::int8_t>(cell, values);
        case CellTag::sparse8:
            return decode_sparse8(cell, values);
        case CellTag::dense16:
            return decode_dense<std::int16_t>(cell, values);
        case CellTag::bitmap16:
            return decode_bitmap<std::int16_t>(cell, values);
        case CellTag::dense32f:
            return decode_dense<float>(cell, values);
        case CellTag::split_dense8:
        case CellTag::split_bitmap8:
        case CellTag::split_sparse8:
            return decode_split(tag, cell, values);
    }
    return cell;
}

std::uint32_t cell_nonzeros(CellTag tag, const std::uint8_t* cell) {
    if (tag == CellTag::bitmap8 || tag == CellTag::bitmap16) {
        return bitmap_population(cell);
    }
    if (tag == CellTag::sparse8) {
        return cell[0];
    }
    DecodedCell values;
    decode_cell(tag, cell, values);
    return static_cast<std::uint32_t>(
        std::count_if(values.begin(), values.end(), [](float value) { return value != 0; }));
}

}  // namespace relume::transport
