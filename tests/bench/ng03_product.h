// The paper's own code: 8-bit values with 8-bit indices in blocks of 256 [Ng03 §5].
#pragma once

#include "tests/bench/sparse_columns.h"

#include <cstdint>
#include <vector>

namespace relume::bench {

// Per column and block a scale and the non-zeros, a byte for the value and a byte for the
// place, added up one after the other. By pixel that is all. To hold the very integers that the
// engine reads, one beyond 8 bits is kept as two or more of them under scales a factor of 256
// apart.
class Ng03Columns {
  public:
    // Keeps a reference.
    explicit Ng03Columns(const SparseColumns& columns);

    // Entries stored, and how many of them a single byte would not do without.
    [[nodiscard]] std::uint64_t entries() const { return entries_; }
    [[nodiscard]] std::uint64_t extra_entries() const { return extra_entries_; }
    // Values, indices, scales and where they belong.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    friend class Ng03Product;

    struct Run {
        std::uint32_t block = 0;  // in the shard
        std::uint32_t count = 0;
        float scale = 0;
    };
    // One column after the other, so that they lie close whatever the heap looked like before.
    struct Shard {
        std::vector<Run> runs;
        std::vector<std::uint8_t> slots;
        std::vector<std::int8_t> values;
        // Of every position, and the end.
        std::vector<std::size_t> first_runs{0};
        std::vector<std::size_t> first_entries{0};
    };

    void append(const transport::ShardReader& reader, std::size_t position, Shard& shard) const;
    void count(const Shard& shard);

    const SparseColumns* columns_;
    std::vector<Shard> shards_;
    std::uint64_t entries_ = 0;
    std::uint64_t extra_entries_ = 0;
    std::uint64_t bytes_ = 0;
};

// An image that changes are added to. A shard's part of it stays in the second-level cache
// while its columns go by; shards are spread over the calling arena. Not thread-safe.
class Ng03Product {
  public:
    explicit Ng03Product(const Ng03Columns& columns);

    void add(std::span<const engine::ColumnChange> changes);
    // [blocks][3][256], in the basis of the columns, before tint.
    [[nodiscard]] std::vector<float> sums() const;

  private:
    using Weights = std::array<float, transport::kColours>;

    static void add_column(const Ng03Columns::Shard& shard,
                           std::size_t position,
                           const Weights& weights,
                           float* image);

    const Ng03Columns* columns_;
    std::vector<float> image_;  // [blocks][256][3]
};

}  // namespace relume::bench
