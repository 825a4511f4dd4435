// Many rows of equal length; adding some moves none.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace relume::bake {

class RowStore {
  public:
    explicit RowStore(std::size_t row_size) : row_size_(row_size) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    // Their values are zero.
    void grow(std::size_t count) {
        while (chunks_.size() * kRowsPerChunk < count) {
            chunks_.push_back(std::make_unique<float[]>(kRowsPerChunk * row_size_));
        }
        count_ = count;
    }
    [[nodiscard]] std::span<float> row(std::size_t i) {
        return {&chunks_[i / kRowsPerChunk][i % kRowsPerChunk * row_size_], row_size_};
    }
    [[nodiscard]] std::span<const float> row(std::size_t i) const {
        return {&chunks_[i / kRowsPerChunk][i % kRowsPerChunk * row_size_], row_size_};
    }

  private:
    static constexpr std::size_t kRowsPerChunk = 1024;

    std::size_t row_size_;
    std::size_t count_ = 0;
    std::vector<std::unique_ptr<float[]>> chunks_;
};

}  // namespace relume::bake
