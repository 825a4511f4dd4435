// What a cell costs in each encoding, in bytes and in time of the kernel: the model by which
// the writer chooses.
#pragma once

#include "protocol/transport/cell.h"
#include "protocol/transport/format.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::transport {

// A value's parts of 8 bits, the lowest first: value = Σ_i 256^i·part_i where three suffice.
using CellParts = std::array<std::int32_t, kMaxParts>;
[[nodiscard]] CellParts parts_of(std::int32_t value);

// What the cost of a cell depends on.
struct CellShape {
    // Values that are not zero, and strips that hold any.
    struct Occupancy {
        std::size_t nonzeros = 0;
        std::size_t strips = 0;
    };
    Occupancy all;
    // Of the parts q = Σ_i 256^i·part_i, the lowest first.
    std::array<Occupancy, kMaxParts> parts;
    std::int32_t least = 0;
    std::int32_t largest = 0;

    [[nodiscard]] static CellShape of(const QuantisedCell& values);

    // Whether an encoding can hold such a cell.
    [[nodiscard]] bool fits(CellTag tag) const;
    // `tag` fits.
    [[nodiscard]] std::size_t bytes(CellTag tag) const;
    // Of one thread that adds the cell, found in the second-level cache, to sums in three
    // colours; `tag` fits. Measured (tests/bench/README.md).
    [[nodiscard]] double nanoseconds(CellTag tag) const;
    // Nanoseconds, bytes turned into time.
    [[nodiscard]] double cost(CellTag tag) const;
    // The encoding of the least cost.
    [[nodiscard]] CellTag cheapest() const;
};

// The rate of exchange: what a byte of memory and file is worth, not what it takes to read one
// (two threads that read 25 GB/s between them wait 0.08 ns for it).
inline constexpr double kNanosecondsPerByte = 1.28;

}  // namespace relume::transport
