// The transport once more, arranged for whole products: block by block, and within a block the
// strips that all columns have at one place lie side by side.
#pragma once

#include "protocol/transport/transport.h"
#include "server/engine/columns/column_table.h"
#include "server/engine/kernels/strip_product.h"
#include "server/engine/operators/transport_operator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A transport's files are ordered by column, because images of few terms read few columns. In
// that order a whole product loads and stores a strip's sums once for every column. In the
// order of this class they stay in registers for hundreds of columns. Immutable; safe to share
// between threads.
class StripMatrix {
  public:
    // `columns` is the table of the transport's columns; a reference to it is kept. The work is
    // spread over the caller's arena.
    StripMatrix(const transport::Transport& transport, const ColumnTable& columns);

    [[nodiscard]] std::uint32_t block_count() const {
        return static_cast<std::uint32_t>(blocks_.size());
    }
    // The bands in which a block has anything, a bit each.
    [[nodiscard]] std::uint32_t bands_of_block(std::uint32_t block) const {
        return blocks_[block].bands;
    }
    // Bytes of memory of all blocks, and of one block. A whole product reads all of them.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t bytes_of_block(std::uint32_t block) const {
        return blocks_[block].bytes();
    }

    // The weights of all columns by channel, columns in the order of ColumnTable::by_band:
    // [K][N][4].
    using Weights = TransportOperator::Weights;
    using Member = TransportOperator::Member;
    // As TransportOperator.
    void multiply(std::uint32_t block,
                  std::uint32_t band,
                  std::span<const Member> members) const;

    // `signal` is planar [3][N]. The quantisation steps and the colours of the channels go
    // into the weights.
    void set_weights(const transport::Transport& transport,
                     std::span<const float> signal,
                     Weights& weights) const;

  private:
    // Strips of one chunk of columns, one channel and one kind.
    struct Run {
        std::uint16_t chunk = 0;
        std::uint8_t channel = 0;
        std::uint8_t kind = 0;
        std::array<std::uint32_t, transport::kStripsPerBlock + 1> begins{};
    };
    template <typename Value>
    struct Strips {
        std::vector<std::uint16_t> columns;
        std::vector<Value> values;  // [columns][8]

        void resize(std::size_t count) {
            columns.resize(count);
            values.resize(transport::kStripSlots * count);
        }
        [[nodiscard]] std::uint64_t bytes() const {
            return columns.size() * sizeof(std::uint16_t) + values.size() * sizeof(Value);
        }
    };
    struct Block {
        std::uint32_t bands = 0;
        std::vector<Run> runs;  // by chunk
        Strips<std::int8_t> parts;
        Strips<float> floats;

        [[nodiscard]] std::uint64_t bytes() const {
            return runs.size() * sizeof(Run) + parts.bytes() + floats.bytes();
        }
    };
    class ShardArranger;

    const ColumnTable* columns_;
    std::vector<Block> blocks_;
    std::uint64_t bytes_ = 0;
};

}  // namespace relume::engine
