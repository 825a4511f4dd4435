// What takes a signal to receivers: the matrix T as sums see it.
#pragma once

#include "server/engine/columns/column_change.h"
#include "server/engine/columns/column_table.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Sums of receivers come in blocks of 256 slots and three colours, [blocks][3][256]. What a
// slot stands for is for a view to know: a pixel, a vertex, a coefficient of a block's basis,
// or one of several terms, whose blocks follow one another.
//
// An operator is immutable and safe to share between threads. Its virtual functions are called
// once a run of blocks or a block, never once a column. The order in which an operator adds is
// its own, and the same on every call and in any company: so results have the same bits.
class TransportOperator {
  public:
    virtual ~TransportOperator() = default;
    TransportOperator(const TransportOperator&) = delete;
    TransportOperator& operator=(const TransportOperator&) = delete;

    [[nodiscard]] const ColumnTable& columns() const { return columns_; }
    [[nodiscard]] std::uint32_t block_count() const { return block_count_; }
    // Floats of one set of sums: [blocks][3][256].
    [[nodiscard]] std::size_t sum_count() const {
        return std::size_t{block_count_} * transport::kColours * transport::kBlockSize;
    }

    // Neighbouring blocks that changed columns are added to together. Runs, in order, are all
    // blocks.
    struct BlockRun {
        std::uint32_t first = 0;
        std::uint32_t count = 0;  // at most 64
    };
    [[nodiscard]] virtual std::size_t run_count() const = 0;
    [[nodiscard]] virtual BlockRun run(std::size_t number) const = 0;

    // Where a run's changes are added: [count][3][256] each, with no overlap. `total` may be
    // null; `occupied` too, else it is set to the blocks of the run in which anything was
    // added, a bit each.
    struct RunTargets {
        float* sums = nullptr;
        float* total = nullptr;
        std::uint64_t* occupied = nullptr;
    };
    // Adds T_j·(to − from) of every change to both targets.
    virtual void add(std::size_t run,
                     std::span<const ColumnChange> changes,
                     const RunTargets& targets) const = 0;

    // A whole signal as `multiply` takes it: an operator's own, of its length and order.
    using Weights = std::vector<float>;
    // Of a signal, planar [3][N].
    virtual void set_weights(std::span<const float> signal, Weights& weights) const = 0;

    // One who has a product made.
    struct Member {
        const Weights* weights = nullptr;
        float* sums = nullptr;  // of the block and band, [3][256]
    };
    // Adds a block's rows of one band, times the members' weights, to their sums. Any number of
    // members, each getting the bits it would get alone.
    virtual void multiply(std::uint32_t block,
                          std::uint32_t band,
                          std::span<const Member> members) const = 0;
    // The bands in which a block has anything, a bit each.
    [[nodiscard]] virtual std::uint32_t bands_of_block(std::uint32_t block) const = 0;
    // What a whole product reads of one block, and of all.
    [[nodiscard]] virtual std::uint64_t product_bytes_of_block(std::uint32_t block) const = 0;
    [[nodiscard]] virtual std::uint64_t product_bytes() const = 0;

  protected:
    TransportOperator(ColumnTable::Columns columns, std::uint32_t block_count)
        : columns_(std::move(columns)), block_count_(block_count) {}

  private:
    ColumnTable columns_;
    std::uint32_t block_count_;
};

}  // namespace relume::engine
