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
// once for a run of blocks or for a block, never once for a column. Each operator adds in an
// order of its own. That order is the same on every call, whoever else is served in the call,
// so that equal inputs give equal bits.
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

    // A run is a number of neighbouring blocks, to which changed columns are added in one call
    // of `add`. Every block is in exactly one run, and runs are in the order of blocks.
    struct BlockRun {
        std::uint32_t first = 0;
        std::uint32_t count = 0;  // at most 64
    };
    [[nodiscard]] virtual std::size_t run_count() const = 0;
    [[nodiscard]] virtual BlockRun run(std::size_t number) const = 0;

    // Where a run's changes are added: two sets of sums, [count][3][256] each, which do not
    // overlap. `total` may be null. Where `occupied` is not null it is set to a mask: bit b
    // says that anything was added to block b of the run.
    struct RunSums {
        float* sums = nullptr;
        float* total = nullptr;
        std::uint64_t* occupied = nullptr;
    };
    // Adds T_j·(to − from) of every change to `sums` and to `total`.
    virtual void add(std::size_t run,
                     std::span<const ColumnChange> changes,
                     const RunSums& targets) const = 0;

    // A whole signal in the form that this operator's `multiply` takes. Length and order are
    // the operator's own affair.
    using Weights = std::vector<float>;
    // `signal` is planar [3][N].
    virtual void set_weights(std::span<const float> signal, Weights& weights) const = 0;

    // One of the signals that are multiplied in one call of `multiply`.
    struct Member {
        const Weights* weights = nullptr;  // the whole signal
        float* sums = nullptr;             // what its product is added to, [3][256]
    };
    // For every member, multiplies the part of T that lies in the block's rows and the band's
    // columns by the member's signal, and adds the product to the member's sums. A member gets
    // the same bits alone and among any number of others.
    virtual void multiply(std::uint32_t block,
                          std::uint32_t band,
                          std::span<const Member> members) const = 0;
    // Bit b: T is not zero all over in the block's rows and the columns of band b.
    [[nodiscard]] virtual std::uint32_t bands_of_block(std::uint32_t block) const = 0;
    // Bytes that the product of T and a whole signal reads of one block, and of all blocks.
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
