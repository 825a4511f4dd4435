#include "server/engine/full_product.h"

#include "server/engine/kernels/accumulate_batch.h"

#include <boost/container/small_vector.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace relume::engine {

void FullProduct::start(std::span<const float> lighting, std::size_t first_shard) {
    if (images_.empty()) {
        images_.emplace_back(*scene_);
    }
    lighting_.assign(lighting.begin(), lighting.end());
    next_shard_ = first_shard;
    shards_left_ = scene_->transport().shards().size();
}

std::uint64_t FullProduct::advance_together(std::span<FullProduct* const> products,
                                            std::uint64_t bytes) {
    boost::container::small_vector<FullProduct*, kMaxBatchMembers> by_shard(products.begin(),
                                                                            products.end());
    std::sort(by_shard.begin(), by_shard.end(), [](const FullProduct* a, const FullProduct* b) {
        return a->next_shard_ < b->next_shard_;
    });
    std::uint64_t read = 0;
    for (auto first = by_shard.begin(); first != by_shard.end();) {
        const auto last = std::find_if(first, by_shard.end(), [&](const FullProduct* other) {
            return other->next_shard_ != (*first)->next_shard_;
        });
        const auto count =
            std::min(last - first, static_cast<std::ptrdiff_t>(kMaxBatchMembers));
        read += sweep(std::span(&*first, static_cast<std::size_t>(count)), bytes);
        first += count;
    }
    return read;
}

std::uint64_t FullProduct::sweep(std::span<FullProduct* const> products, std::uint64_t bytes) {
    const Scene& scene = *products.front()->scene_;
    const std::size_t shards = scene.transport().shards().size();
    const std::uint64_t bytes_per_shard = scene.transport().total_bytes() / shards + 1;
    const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
    // A slice that would leave threads idle takes no less time than one that occupies them all.
    const std::uint64_t wanted = std::max(bytes / bytes_per_shard / threads * threads, threads);
    const std::size_t first = products.front()->next_shard_;
    std::size_t last = std::min<std::uint64_t>(shards, first + wanted);
    boost::container::small_vector<BandImages::Rebuild, kMaxBatchMembers> rebuilds;
    for (FullProduct* product : products) {
        last = std::min(last, first + product->shards_left_);
        rebuilds.push_back(
            {.images = &product->images_.front(), .lighting = product->lighting_});
    }
    BandImages::rebuild_together(first, last, std::span(rebuilds.data(), rebuilds.size()));
    for (FullProduct* product : products) {
        product->next_shard_ = last % shards;
        product->shards_left_ -= last - first;
    }
    return bytes_per_shard * (last - first) * products.size();
}

void FullProduct::exchange(BandImages& images) {
    std::swap(images, images_.front());
}

}  // namespace relume::engine
