// A cell: the 256 receivers of one block in one column, stored in the cheapest of several
// encodings (protocol/README.md §2). The byte layout of segments and cells is known here only.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

using QuantisedCell = std::array<std::int32_t, kBlockSize>;
using DecodedCell = std::array<float, kBlockSize>;

// Appends the cell in the encoding of the least cost (cell_cost.h) and returns its tag. Values
// beyond 16 bits are stored as floats.
CellTag append_cell(const QuantisedCell& values, std::vector<std::uint8_t>& bytes);

// Appends the cell in this encoding, which fits it (CellShape::fits).
void append_cell_as(CellTag tag, const QuantisedCell& values, std::vector<std::uint8_t>& bytes);

// Bytes of the cell that begins at `bytes`. Throws TransportError (without a file name) when
// the tag is unknown, the cell does not fit into `bytes`, or its content is not allowed.
std::size_t validated_cell_bytes(std::uint8_t tag, std::span<const std::uint8_t> bytes);

// Bytes of a cell that has been validated.
[[nodiscard]] std::size_t cell_bytes(CellTag tag, const std::uint8_t* cell);

// Writes all 256 values of a validated cell, unscaled; returns the byte after it.
const std::uint8_t* decode_cell(CellTag tag, const std::uint8_t* cell, DecodedCell& values);

// Non-zero values a validated cell stores.
[[nodiscard]] std::uint32_t cell_nonzeros(CellTag tag, const std::uint8_t* cell);

// The lowest bit of every one of sixteen tags that is not `empty`.
[[nodiscard]] constexpr std::uint64_t occupied_tags(std::uint64_t tags) {
    tags |= tags >> 1U;
    tags |= tags >> 2U;
    return tags & 0x1111'1111'1111'1111U;
}

// A validated segment: the cells of one column and channel in one shard. Null when all-zero.
struct SegmentView {
    const std::uint8_t* tags = nullptr;
    const std::uint8_t* cells = nullptr;
    const std::uint8_t* end = nullptr;  // of the cells

    [[nodiscard]] bool empty() const { return tags == nullptr; }
    [[nodiscard]] CellTag tag(std::uint32_t block_in_shard) const {
        const unsigned shift = (block_in_shard & 1U) * 4U;
        return static_cast<CellTag>((std::uint32_t{tags[block_in_shard / 2]} >> shift) & 0xFU);
    }
    // Bit b: block b of the shard's `block_count` has a cell.
    [[nodiscard]] std::uint64_t occupied_blocks(std::uint32_t block_count) const;
};

[[nodiscard]] constexpr std::size_t tag_bytes(std::uint32_t block_count) {
    return (block_count + 1) / 2;
}

}  // namespace relume::transport
