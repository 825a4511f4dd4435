#include "server/engine/spare_images.h"

#include <utility>

namespace relume::engine {

SpareImages::SpareImages() {
    spare_.reserve(kMaxBatchMembers);
}

BandImages SpareImages::take(const Scene& scene) {
    {
        const std::lock_guard lock(mutex_);
        if (!spare_.empty()) {
            BandImages images = std::move(spare_.back());
            spare_.pop_back();
            return images;
        }
    }
    return BandImages(scene);
}

void SpareImages::give(BandImages&& images) {
    BandImages given = std::move(images);  // freed, if they are, without the lock
    const std::lock_guard lock(mutex_);
    if (spare_.size() < kMaxBatchMembers) {
        spare_.push_back(std::move(given));
    }
}

}  // namespace relume::engine
