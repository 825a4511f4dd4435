#include "protocol/transport/cell.h"

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

void append_sparse8(const QuantisedCell& values,
                    std::size_t nonzeros,
                    std::vector<std::uint8_t>& bytes) {
    bytes.push_back(static_cast<std::uint8_t>(nonzeros));
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if (values[slot] != 0) {
            bytes.push_back(static_cast<std::uint8_t>(slot));
        }
    }
    append_nonzero<std::int8_t>(values, bytes);
}

CellTag append_cell8(const QuantisedCell& values,
                     std::size_t nonzeros,
                     std::vector<std::uint8_t>& bytes) {
    const std::size_t sparse = 1 + 2 * nonzeros;
    const std::size_t bitmap = kBitmapBytes + nonzeros;
    if (sparse <= bitmap) {
        append_sparse8(values, nonzeros, bytes);
        return CellTag::sparse8;
    }
    if (bitmap < kBlockSize) {
        append_bitmap(values, bytes);
        append_nonzero<std::int8_t>(values, bytes);
        return CellTag::bitmap8;
    }
    append_all<std::int8_t>(values, bytes);
    return CellTag::dense8;
}

std::size_t cell16_bytes(std::size_t nonzeros) {
    return std::min(kBitmapBytes + sizeof(std::int16_t) * nonzeros,
                    sizeof(std::int16_t) * std::size_t{kBlockSize});
}

CellTag append_cell16(const QuantisedCell& values,
                      std::size_t nonzeros,
                      std::vector<std::uint8_t>& bytes) {
    if (cell16_bytes(nonzeros) < 2 * std::size_t{kBlockSize}) {
        append_bitmap(values, bytes);
        append_nonzero<std::int16_t>(values, bytes);
        return CellTag::bitmap16;
    }
    append_all<std::int16_t>(values, bytes);
    return CellTag::dense16;
}

// q = low + 256·high with low in 8 bits.
struct SplitCell {
    QuantisedCell low;
    QuantisedCell high;
    std::size_t low_nonzeros = 0;
    std::size_t high_nonzeros = 0;
};

SplitCell split(const QuantisedCell& values) {
    SplitCell cell;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        const std::int32_t low = static_cast<std::int8_t>(values[slot] & 0xFF);
        cell.low[slot] = low;
        cell.high[slot] = (values[slot] - low) / kHighPart;
        cell.low_nonzeros += low != 0 ? 1U : 0U;
        cell.high_nonzeros += cell.high[slot] != 0 ? 1U : 0U;
    }
    return cell;
}

// Values of 16 bits: split where that takes fewer bytes.
CellTag append_wide_cell(const QuantisedCell& values,
                         std::size_t nonzeros,
                         std::vector<std::uint8_t>& bytes) {
    const SplitCell parts = split(values);
    const bool high_fits = std::all_of(parts.high.begin(), parts.high.end(), [](auto high) {
        return high <= std::numeric_limits<std::int8_t>::max();
    });
    const std::size_t high_bytes = 1 + 2 * parts.high_nonzeros;
    const std::size_t low_bytes =
        std::min({1 + 2 * parts.low_nonzeros, kBitmapBytes + parts.low_nonzeros,
                  std::size_t{kBlockSize}});
    if (!high_fits || parts.low_nonzeros == 0 ||
        parts.high_nonzeros > std::numeric_limits<std::uint8_t>::max() ||
        high_bytes + low_bytes >= cell16_bytes(nonzeros)) {
        return append_cell16(values, nonzeros, bytes);
    }
    append_sparse8(parts.high, parts.high_nonzeros, bytes);
    const CellTag tag = append_cell8(parts.low, parts.low_nonzeros, bytes);
    return static_cast<CellTag>(static_cast<std::uint8_t>(tag) +
                                static_cast<std::uint8_t>(CellTag::split_dense8) -
                                static_cast<std::uint8_t>(CellTag::dense8));
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
    std::size_t nonzeros = 0;
    std::int32_t low = 0;
    std::int32_t high = 0;
    for (const std::int32_t value : values) {
        nonzeros += value != 0 ? 1 : 0;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    const auto fits = [low, high]<typename T>(T /*type*/) {
        return low >= std::numeric_limits<T>::min() && high <= std::numeric_limits<T>::max();
    };
    if (nonzeros == 0) {
        return CellTag::empty;
    }
    if (fits(std::int8_t{})) {
        return append_cell8(values, nonzeros, bytes);
    }
    if (fits(std::int16_t{})) {
        return append_wide_cell(values, nonzeros, bytes);
    }
    append_all<float>(values, bytes);
    return CellTag::dense32f;
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
