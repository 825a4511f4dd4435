// Sums that a whole product was made in and that nobody shows any more.
#pragma once

#include "server/engine/sums/band_sums.h"

#include <array>
#include <atomic>
#include <memory>

namespace relume::engine {

// A session needs a second set of sums only while its product is being made; sets that are
// free go to whoever of the workspace begins the next, their memory being at hand. Thread-safe,
// and nobody waits for anybody.
class SpareSums {
  public:
    SpareSums() = default;
    SpareSums(const SpareSums&) = delete;
    SpareSums& operator=(const SpareSums&) = delete;
    ~SpareSums();

    // Whatever they hold: a product sets all of it.
    [[nodiscard]] std::unique_ptr<BandSums> take(const TransportOperator& of);
    // Keeps as many as are needed together in one sweep, frees the others.
    void give(std::unique_ptr<BandSums> sums);

  private:
    std::array<std::atomic<BandSums*>, kMaxBatchMembers> spare_{};  // owned, or null
};

}  // namespace relume::engine
