// The whole product T·L, made from nothing in slices of a budget, aside from the sums that are
// shown.
#pragma once

#include "server/engine/operators/transport_operator.h"
#include "server/engine/sums/band_sums.h"
#include "server/engine/sums/spare_sums.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace relume::engine {

// Sums run in the order of bands and columns whatever came before and whoever is swept with it,
// so the result depends on the signal alone. Not thread-safe.
class FullProduct {
  public:
    // Keeps references to both. Sums that it works in are borrowed from the spare ones.
    FullProduct(const TransportOperator& of, SpareSums& spare)
        : operator_(&of), spare_(&spare) {}

    [[nodiscard]] bool running() const { return blocks_left_ > 0; }
    // Begins anew with this signal, planar [3][N], at any block: it goes around. Products
    // that stand at the same block are swept together.
    void start(std::span<const float> signal, std::uint32_t first_block = 0);
    void abandon();
    [[nodiscard]] std::uint32_t next_block() const { return next_block_; }

    // Each of the products, all running and of one operator, goes through some blocks, and
    // on until about `bytes` have been read; returns the bytes read, those that
    // several shared counted for each. One ends with running() false when all is done.
    static std::uint64_t advance_together(std::span<FullProduct* const> products,
                                          std::uint64_t bytes);
    std::uint64_t advance(std::uint64_t bytes) {
        FullProduct* const product = this;
        return advance_together({&product, 1}, bytes);
    }

    // Hands the finished sums over in exchange for the ones given.
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
