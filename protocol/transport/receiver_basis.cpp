#include "protocol/transport/receiver_basis.h"

#include "protocol/basis/haar.h"

#include <array>

namespace relume::transport {

void block_coefficients_from_receivers(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> scratch;
    basis::haar_forward(kTileSide, values, scratch);
}

void block_receivers_from_coefficients(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> scratch;
    basis::haar_inverse(kTileSide, values, scratch);
}

}  // namespace relume::transport
