#include "precompute/bake/block_encoder.h"

namespace relume::bake {

transport::EncodedBlock BlockEncoder::encode(std::size_t segments) const {
    // A counting sort by column: only what is not zero moves.
    std::vector<std::uint32_t> begin(segments + 1, 0);
    for (const auto& row : rows_) {
        for (const transport::QuantisedValue& value : row) {
            ++begin[value.column + 1];
        }
    }
    for (std::size_t i = 0; i < segments; ++i) {
        begin[i + 1] += begin[i];
    }
    struct SlotValue {
        std::uint32_t slot;
        std::int32_t value;
    };
    std::vector<SlotValue> sorted(begin[segments]);
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
        for (const transport::QuantisedValue& value : rows_[slot]) {
            sorted[next[value.column]++] = {slot, value.value};
        }
    }
    transport::EncodedBlock block(segments);
    transport::QuantisedCell cell{};
    for (std::size_t i = 0; i < segments; ++i) {
        for (std::uint32_t at = begin[i]; at < begin[i + 1]; ++at) {
            cell[sorted[at].slot] = sorted[at].value;
        }
        block.append(cell);
        for (std::uint32_t at = begin[i]; at < begin[i + 1]; ++at) {
            cell[sorted[at].slot] = 0;
        }
    }
    return block;
}

}  // namespace relume::bake
