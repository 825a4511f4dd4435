#include "server/engine/spare_images.h"

namespace relume::engine {

SpareImages::~SpareImages() {
    for (std::atomic<BandImages*>& place : spare_) {
        delete place.load();
    }
}

std::unique_ptr<BandImages> SpareImages::take(const Scene& scene) {
    for (std::atomic<BandImages*>& place : spare_) {
        if (BandImages* const images = place.exchange(nullptr)) {
            return std::unique_ptr<BandImages>(images);
        }
    }
    return std::make_unique<BandImages>(scene);
}

void SpareImages::give(std::unique_ptr<BandImages> images) {
    for (std::atomic<BandImages*>& place : spare_) {
        BandImages* nothing = nullptr;
        if (place.compare_exchange_strong(nothing, images.get())) {
            static_cast<void>(images.release());
            return;
        }
    }
}

}  // namespace relume::engine
