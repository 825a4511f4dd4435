// The whole product T·L, made from nothing in slices, in sums of its own. The sums that are
// shown stay as they are until it is done.
#pragma once

#include "server/engine/operators/transport_operator.h"
#include "server/engine/sums/band_sums.h"
#include "server/engine/sums/spare_sums.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace relume::engine {

// Additions have one order, by band and column, whatever was shown before and whatever other
// products are made in the same sweep. So the result depends on the signal alone, to the last
// bit. Not thread-safe.
class FullProduct {
  public:
    // Keeps references to both. It borrows the sums that it works in from `spare`.
    FullProduct(const TransportOperator& of, SpareSums& spare)
        : operator_(&of), spare_(&spare) {}

    [[nodiscard]] bool running() const { return blocks_left_ > 0; }
    // Begins anew with this signal, planar [3][N]. It begins at `first_block` and goes around,
    // so that it can join another product: those that stand at the same block are swept
    // together.
    void start(std::span<const float> signal, std::uint32_t first_block = 0);
    void abandon();
    [[nodiscard]] std::uint32_t next_block() const { return next_block_; }

    // Each of the products, all running and of one operator, goes on through its blocks until
    // about `bytes` have been read. Returns the bytes read; bytes that several products shared
    // count for each of them. running() of a product is false once it is done.
    static std::uint64_t advance_together(std::span<FullProduct* const> products,
                                          std::uint64_t bytes);
    std::uint64_t advance(std::uint64_t bytes) {
        FullProduct* const product = this;
        return advance_together({&product, 1}, bytes);
    }

    // Swaps the finished sums with `sums`, which go back to the spare ones.
    void exchange(BandSums& sums);

  private:
    // All of them stand at the same block.
    static std::uint64_t sweep(std::span<FullProduct* const> products, std::uint64_t bytes);

    const TransportOperator* operator_;
    SpareSums* spare_;
    std::unique_ptr<BandSums> sums_;  // borrowed while it runs
    TransportOperator::Weights weights_;
    std::uint32_t next_block_ = 0;
    std::uint32_t blocks_left_ = 0;
};

}  // namespace relume::engine
