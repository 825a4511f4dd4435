// The transport once more, arranged for whole products: block by block, and in a block all
// columns' strips at one place side by side.
#pragma once

#include "protocol/transport/transport.h"
#include "server/engine/columns/column_table.h"
#include "server/engine/kernels/strip_product.h"
#include "server/engine/operators/transport_operator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A transport's files are ordered by column, because images of few terms read few columns. To
// read them all in that order costs two additions in memory for each in a register; in this one
// a strip's sums stay in registers for hundreds of columns. Immutable; safe to share between
// threads.
class StripMatrix {
  public:
    // Keeps a reference to the columns, which are the transport's. In parallel.
    StripMatrix(const transport::Transport& transport, const ColumnTable& columns);

    [[nodiscard]] std::uint32_t block_count() const {
        return static_cast<std::uint32_t>(blocks_.size());
    }
    // The bands in which a block has anything, a bit each.
    [[nodiscard]] std::uint32_t bands_of_block(std::uint32_t block) const {
        return blocks_[block].bands;
    }
    // Bytes of memory: of all blocks, and of one, which is what its part of a product reads.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t bytes_of_block(std::uint32_t block) const {
        return blocks_[block].bytes();
    }

    // The weights of all columns, per channel and ordered as the bands are: [K][N][4].
    using Weights = TransportOperator::Weights;
    using Member = TransportOperator::Member;
    // As TransportOperator.
    void multiply(std::uint32_t block,
                  std::uint32_t band,
                  std::span<const Member> members) const;

    // Of a signal, planar [3][N], with the channels' steps and colours.
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
