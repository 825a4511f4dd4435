#include "server/engine/sums/full_product.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <utility>

namespace relume::engine {
namespace {

// Enough to occupy all threads of a few processors evenly, and a few hundred microseconds.
constexpr std::uint64_t kFewestBlocks = 16;

}  // namespace

void FullProduct::start(std::span<const float> signal, std::uint32_t first_block) {
    if (!sums_) {
        sums_ = spare_->take(*operator_);
    }
    operator_->set_weights(signal, weights_);
    next_block_ = first_block;
    blocks_left_ = operator_->block_count();
}

void FullProduct::abandon() {
    blocks_left_ = 0;
    if (sums_) {
        spare_->give(std::move(sums_));
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
    const TransportOperator& of = *products.front()->operator_;
    const std::uint32_t blocks = of.block_count();
    const std::uint32_t first = products.front()->next_block_;
    std::uint32_t most = blocks - first;
    boost::container::small_vector<BandSums::Rebuild, kMaxBatchMembers> rebuilds;
    for (FullProduct* product : products) {
        most = std::min(most, product->blocks_left_);
        rebuilds.push_back({.sums = product->sums_.get(), .weights = &product->weights_});
    }
    std::uint32_t count = 0;
    std::uint64_t read = 0;
    while (count < most && (count < kFewestBlocks || read < bytes)) {
        read += of.product_bytes_of_block(first + count++);
    }
    BandSums::rebuild_together(first, first + count,
                               std::span(rebuilds.data(), rebuilds.size()));
    for (FullProduct* product : products) {
        product->next_block_ = (first + count) % blocks;
        product->blocks_left_ -= count;
    }
    return read * products.size();
}

void FullProduct::exchange(BandSums& sums) {
    std::swap(sums, *sums_);
    abandon();
}

}  // namespace relume::engine
