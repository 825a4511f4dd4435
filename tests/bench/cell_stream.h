// Columns of one shard made from a seed, all cells of one kind: what a kernel is measured on.
#pragma once

#include "protocol/transport/cell.h"
#include "server/engine/kernels/accumulate.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::bench {

struct CellKind {
    std::string name;
    std::uint32_t nonzeros = 0;  // of each cell, in random slots
    std::int32_t range = 127;    // values are in ±range, not zero
};

// Every encoding, strips at several densities; a name begins with its encoding.
[[nodiscard]] const std::vector<CellKind>& cell_kinds();

class CellStream {
  public:
    static constexpr std::size_t kFewestColumns = 32;

    // As many columns of `block_count` cells as fill `bytes`, at least kFewestColumns of them.
    CellStream(const CellKind& kind, std::uint32_t block_count, std::size_t bytes);

    [[nodiscard]] const std::vector<engine::WeightedSegment>& segments() const {
        return segments_;
    }
    [[nodiscard]] std::uint32_t block_count() const { return block_count_; }
    // Tags and cells.
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t cells() const { return segments_.size() * block_count_; }
    [[nodiscard]] std::uint64_t nonzeros() const { return cells() * nonzeros_per_cell_; }

  private:
    std::uint32_t block_count_;
    std::uint32_t nonzeros_per_cell_;
    std::size_t bytes_ = 0;
    std::vector<std::uint8_t> data_;
    std::vector<engine::WeightedSegment> segments_;
};

}  // namespace relume::bench
