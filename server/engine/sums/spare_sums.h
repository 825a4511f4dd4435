// Sets of sums that whole products are made in, kept between two products.
#pragma once

#include "server/engine/sums/band_sums.h"

#include <array>
#include <atomic>
#include <memory>

namespace relume::engine {

// A session needs a second set of sums only while its whole product is made. A set that is free
// goes to the session of the workspace that begins the next product, so that its memory need
// not be asked of the system again. Thread-safe, without locks.
class SpareSums {
  public:
    SpareSums() = default;
    SpareSums(const SpareSums&) = delete;
    SpareSums& operator=(const SpareSums&) = delete;
    ~SpareSums();

    // A set of unknown content: a product sets all of it.
    [[nodiscard]] std::unique_ptr<BandSums> take(const TransportOperator& of);
    // Keeps at most kMaxBatchMembers sets, as many as one sweep needs, and frees further ones.
    void give(std::unique_ptr<BandSums> sums);

  private:
    std::array<std::atomic<BandSums*>, kMaxBatchMembers> spare_{};  // owned, or null
};

}  // namespace relume::engine
