#include "precompute/bake/blocks/block_encoder.h"

#include "protocol/transport/block_basis.h"
#include "protocol/transport/quantise.h"

#include <cmath>

namespace relume::bake {
namespace {

using transport::kBlockSize;

// Columns transposed at once: a cache line of every row.
constexpr std::size_t kGroupColumns = 16;
using Cell = std::array<float, kBlockSize>;
using ColumnGroup = std::array<Cell, kGroupColumns>;

// Receivers without a row are not looked at: they get what costs the fewest coefficients, in
// wavelets the mean of the others.
void transpose(transport::BlockBasis basis,
               const BlockRows& rows,
               std::uint32_t channel,
               std::size_t first,
               std::size_t count,
               ColumnGroup& group) {
    std::array<float, kGroupColumns> mean{};
    const float share =
        basis == transport::BlockBasis::identity
            ? 0
            : 1 / static_cast<float>(std::max<std::size_t>(rows.present_count(), 1));
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        if (const float* row = rows.row(slot, channel); row != nullptr) {
            for (std::size_t i = 0; i < count; ++i) {
                group[i][slot] = row[first + i];
                mean[i] += share * row[first + i];
            }
        }
    }
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        for (std::size_t i = 0; rows.row(slot, channel) == nullptr && i < count; ++i) {
            group[i][slot] = mean[i];
        }
    }
}

// No coefficient is larger than the norm of all values.
bool is_in_dead_zone(const Cell& values, float step) {
    float energy = 0;
    for (const float value : values) {
        energy += value * value;
    }
    constexpr float kRounding = 0.999F;
    return std::sqrt(energy) < kRounding * transport::kDeadZone * step;
}

// Values of a quantised cell at the slots of `stored`, as column j of channel k.
void reconstruct(transport::BlockBasis basis,
                 const transport::QuantisedCell& quantised,
                 float step,
                 std::size_t place,
                 StoredRows& stored) {
    Cell values;
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        values[i] = step * static_cast<float>(quantised[i]);
    }
    transport::block_receivers_from_coefficients(basis, values);
    for (std::size_t i = 0; i < stored.slots.size(); ++i) {
        stored.rows[i][place] = values[stored.slots[i]];
    }
}

}  // namespace

transport::EncodedBlock encode_block(transport::BlockBasis basis,
                                     const BlockRows& rows,
                                     std::span<const float> steps,
                                     StoredRows& stored) {
    const std::uint32_t channels = rows.channels();
    stored.rows.assign(stored.slots.size(), std::vector<float>(rows.columns() * channels));
    transport::EncodedBlock block(steps.size());
    std::array<ColumnGroup, transport::kMaxChannels> groups;
    for (std::size_t first = 0; first < rows.columns(); first += kGroupColumns) {
        const std::size_t count = std::min(kGroupColumns, rows.columns() - first);
        for (std::uint32_t k = 0; k < channels; ++k) {
            transpose(basis, rows, k, first, count, groups[k]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (std::uint32_t k = 0; k < channels; ++k) {
                Cell& values = groups[k][i];
                const float step = steps[(first + i) * channels + k];
                transport::QuantisedCell quantised{};
                if (!is_in_dead_zone(values, step)) {
                    transport::block_coefficients_from_receivers(basis, values);
                    transport::quantise_cell(values, step, quantised);
                    reconstruct(basis, quantised, step, k * rows.columns() + first + i, stored);
                }
                block.append(quantised);
            }
        }
    }
    return block;
}

}  // namespace relume::bake
