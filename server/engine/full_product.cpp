#include "server/engine/full_product.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace relume::engine {

void FullProduct::start(std::span<const float> lighting) {
    if (images_.empty()) {
        images_.emplace_back(*scene_);
    }
    gather_columns(*scene_, lighting, columns_);
    next_shard_ = 0;
    running_ = true;
}

std::uint64_t FullProduct::advance(std::uint64_t bytes) {
    const auto& shards = scene_->transport().shards();
    const std::uint64_t bytes_per_shard = scene_->transport().total_bytes() / shards.size() + 1;
    const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
    // A slice that would leave threads idle takes no less time than one that occupies them all.
    const std::uint64_t wanted = std::max(bytes / bytes_per_shard / threads * threads, threads);
    const std::size_t last = std::min<std::uint64_t>(shards.size(), next_shard_ + wanted);
    images_.front().rebuild(next_shard_, last, columns_);
    const std::uint64_t read = bytes_per_shard * (last - next_shard_);
    next_shard_ = last;
    running_ = next_shard_ < shards.size();
    return read;
}

void FullProduct::exchange(BandImages& images) {
    std::swap(images, images_.front());
}

}  // namespace relume::engine
