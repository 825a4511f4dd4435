#include "server/engine/accumulate.h"

#include <bit>
#include <cstring>

namespace relume::engine {
namespace {

using transport::CellTag;
using transport::kBitmapBytes;
using transport::kBlockSize;
using transport::kColours;

template <typename T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

template <typename T>
const std::uint8_t* add_dense(const std::uint8_t* cell,
                              const ColourWeights& weights,
                              float* sums) {
    float values[kBlockSize];
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        values[i] = static_cast<float>(load<T>(cell + i * sizeof(T)));
    }
    for (std::size_t c = 0; c < kColours; ++c) {
        float* colour = sums + c * kBlockSize;
        const float weight = weights[c];
        for (std::size_t i = 0; i < kBlockSize; ++i) {
            colour[i] += weight * values[i];
        }
    }
    return cell + kBlockSize * sizeof(T);
}

void add_value(float value, const ColourWeights& weights, float* slot) {
    slot[0] += weights[0] * value;
    slot[kBlockSize] += weights[1] * value;
    slot[2 * kBlockSize] += weights[2] * value;
}

template <typename T>
const std::uint8_t* add_bitmap(const std::uint8_t* cell,
                               const ColourWeights& weights,
                               float* sums) {
    const std::uint8_t* packed = cell + kBitmapBytes;
    constexpr std::size_t kWordBits = 64;
    for (std::size_t first = 0; first < kBlockSize; first += kWordBits) {
        for (auto bits = load<std::uint64_t>(cell + first / 8); bits != 0; bits &= bits - 1) {
            const auto slot = first + static_cast<std::size_t>(std::countr_zero(bits));
            add_value(static_cast<float>(load<T>(packed)), weights, sums + slot);
            packed += sizeof(T);
        }
    }
    return packed;
}

const std::uint8_t* add_sparse(const std::uint8_t* cell,
                               const ColourWeights& weights,
                               float* sums) {
    const std::size_t count = cell[0];
    const std::uint8_t* slots = cell + 1;
    const std::uint8_t* values = slots + count;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<float>(static_cast<std::int8_t>(values[i]));
        add_value(value, weights, sums + slots[i]);
    }
    return values + count;
}

}  // namespace

void accumulate_segment(const transport::SegmentView& segment,
                        std::uint32_t block_count,
                        const ColourWeights& weights,
                        float* sums) {
    const std::uint8_t* cell = segment.cells;
    for (std::uint32_t block = 0; block < block_count; ++block, sums += kColours * kBlockSize) {
        switch (segment.tag(block)) {
            case CellTag::empty:
                break;
            case CellTag::dense8:
                cell = add_dense<std::int8_t>(cell, weights, sums);
                break;
            case CellTag::bitmap8:
                cell = add_bitmap<std::int8_t>(cell, weights, sums);
                break;
            case CellTag::sparse8:
                cell = add_sparse(cell, weights, sums);
                break;
            case CellTag::dense16:
                cell = add_dense<std::int16_t>(cell, weights, sums);
                break;
            case CellTag::bitmap16:
                cell = add_bitmap<std::int16_t>(cell, weights, sums);
                break;
            case CellTag::dense32f:
                cell = add_dense<float>(cell, weights, sums);
                break;
        }
    }
}

}  // namespace relume::engine
