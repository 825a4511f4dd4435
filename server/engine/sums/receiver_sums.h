// One set of sums: what the receivers of all blocks have been given.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

namespace relume::engine {

// [blocks][3][256], zero until written. The system gives memory to it page by page when it is
// written. So to make an object for many blocks costs nothing, and filling it is spread over
// the threads that write. Not thread-safe, but different threads may write different blocks.
class ReceiverSums {
  public:
    static constexpr std::size_t kSumsPerBlock =
        std::size_t{transport::kColours} * transport::kBlockSize;

    ReceiverSums() = default;
    explicit ReceiverSums(std::uint32_t block_count)
        : sums_(static_cast<float*>(std::calloc(block_count * kSumsPerBlock, sizeof(float)))),
          block_count_(block_count) {
        if (sums_ == nullptr) {
            throw std::bad_alloc();
        }
    }

    [[nodiscard]] bool empty() const { return sums_ == nullptr; }
    [[nodiscard]] std::span<const float> sums() const {
        return {sums_.get(), block_count_ * kSumsPerBlock};
    }
    // The sums of a block, [3][256]; those of the following blocks lie behind them.
    [[nodiscard]] float* block(std::uint32_t block) {
        return sums_.get() + block * kSumsPerBlock;
    }

  private:
    struct Free {
        void operator()(float* sums) const { std::free(sums); }
    };
    std::unique_ptr<float, Free> sums_;
    std::size_t block_count_ = 0;
};

}  // namespace relume::engine
