#include "server/engine/sums/spare_sums.h"

namespace relume::engine {

SpareSums::~SpareSums() {
    for (std::atomic<BandSums*>& place : spare_) {
        delete place.load();
    }
}

std::unique_ptr<BandSums> SpareSums::take(const TransportOperator& of) {
    for (std::atomic<BandSums*>& place : spare_) {
        if (BandSums* const sums = place.exchange(nullptr)) {
            return std::unique_ptr<BandSums>(sums);
        }
    }
    return std::make_unique<BandSums>(of);
}

void SpareSums::give(std::unique_ptr<BandSums> sums) {
    for (std::atomic<BandSums*>& place : spare_) {
        BandSums* nothing = nullptr;
        if (place.compare_exchange_strong(nothing, sums.get())) {
            static_cast<void>(sums.release());
            return;
        }
    }
}

}  // namespace relume::engine
