#include "server/engine/full_product.h"

#include "server/engine/spare_images.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <utility>

namespace relume::engine {
namespace {

// Enough to occupy all threads of a few processors evenly, and a few hundred microseconds.
constexpr std::uint64_t kFewestBlocks = 16;

}  // namespace

void FullProduct::start(std::span<const float> lighting, std::uint32_t first_block) {
    if (!images_) {
        images_ = scene_->spare_images().take(*scene_);
    }
    scene_->strips().set_weights(scene_->transport(), lighting, weights_);
    next_block_ = first_block;
    blocks_left_ = scene_->block_count();
}

void FullProduct::abandon() {
    blocks_left_ = 0;
    if (images_) {
        scene_->spare_images().give(std::move(images_));
    }
}

std::uint64_t FullProduct::advance_together(std::span<FullProduct* const> products,
                                            std::uint64_t bytes) {
    boost::container::small_vector<FullProduct*, kMaxBatchMembers> by_block(products.begin(),
                                                                            products.end());
    std::sort(by_block.begin(), by_block.end(), [](const FullProduct* a, const FullProduct* b) {
        return a->next_block_ < b->next_block_;
    });
    std::uint64_t read = 0;
    for (auto first = by_block.begin(); first != by_block.end();) {
        const auto last = std::find_if(first, by_block.end(), [&](const FullProduct* other) {
            return other->next_block_ != (*first)->next_block_;
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
    const std::uint32_t blocks = scene.block_count();
    const std::uint32_t first = products.front()->next_block_;
    std::uint32_t most = blocks - first;
    boost::container::small_vector<BandImages::Rebuild, kMaxBatchMembers> rebuilds;
    for (FullProduct* product : products) {
        most = std::min(most, product->blocks_left_);
        rebuilds.push_back({.images = product->images_.get(), .weights = &product->weights_});
    }
    std::uint32_t count = 0;
    std::uint64_t read = 0;
    while (count < most && (count < kFewestBlocks || read < bytes)) {
        read += scene.strips().bytes_of_block(first + count++);
    }
    BandImages::rebuild_together(first, first + count,
                                 std::span(rebuilds.data(), rebuilds.size()));
    for (FullProduct* product : products) {
        product->next_block_ = (first + count) % blocks;
        product->blocks_left_ -= count;
    }
    return read * products.size();
}

void FullProduct::exchange(BandImages& images) {
    std::swap(images, *images_);
    abandon();
}

}  // namespace relume::engine
