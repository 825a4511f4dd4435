// An image before tint, in the basis of its blocks.
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

namespace relume::engine {

// Sums, [blocks][3][256], zero until written. The system takes memory for it page by page as it
// is written, so that to begin an image of many blocks costs nothing, and to fill it is spread
// over the threads that do. Not thread-safe; blocks are apart from one another.
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
    // Of a block and, as they lie one after the other, of those that follow.
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
