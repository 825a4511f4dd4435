// Bitmap cells spread out to all 256 slots. Compiled once per instruction set, as Highway's own
// "-inl" headers are.
#if defined(RELUME_BITMAP_EXPANSION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_BITMAP_EXPANSION_INL_H
#undef RELUME_BITMAP_EXPANSION_INL_H
#else
#define RELUME_BITMAP_EXPANSION_INL_H
#endif

#include "protocol/transport/format.h"
#include "server/engine/kernels/bitmap_shuffles.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

// Spread packed values to the slots whose bits are set. Read up to 64 bytes beyond the cell: a
// shard's data has a tail (kShardTailBytes).
struct BitmapExpansion {
    void (*bits8)(const std::uint8_t* cell, std::int8_t* values);
    void (*bits16)(const std::uint8_t* cell, std::int16_t* values);
};

inline void expand8_by_table(const std::uint8_t* cell, std::int8_t* values) {
    const hwy::HWY_NAMESPACE::CappedTag<std::uint8_t, 8> d8;
    auto* out = reinterpret_cast<std::uint8_t*>(values);
    const std::uint8_t* packed = cell + transport::kBitmapBytes;
    for (std::size_t byte = 0; byte < transport::kBitmapBytes; ++byte, out += 8) {
        const std::uint8_t mask = cell[byte];
        const auto places = hwy::HWY_NAMESPACE::LoadU(d8, kBitmapShuffles[mask].data());
        hwy::HWY_NAMESPACE::StoreU(hwy::HWY_NAMESPACE::TableLookupBytesOr0(
                                       hwy::HWY_NAMESPACE::LoadU(d8, packed), places),
                                   d8, out);
        packed += std::popcount(mask);
    }
}

inline void expand16_one_by_one(const std::uint8_t* cell, std::int16_t* values) {
    std::fill_n(values, transport::kBlockSize, std::int16_t{0});
    const std::uint8_t* packed = cell + transport::kBitmapBytes;
    for (std::size_t byte = 0; byte < transport::kBitmapBytes; ++byte, values += 8) {
        for (unsigned mask = cell[byte]; mask != 0; mask &= mask - 1) {
            std::memcpy(values + std::countr_zero(mask), packed, sizeof(std::int16_t));
            packed += sizeof(std::int16_t);
        }
    }
}

#if HWY_TARGET == HWY_AVX3
// Ice Lake's expansion, which Highway 1.0 has no operation for.
__attribute__((target("avx512vbmi2"))) inline void expand8_by_instruction(
    const std::uint8_t* cell, std::int8_t* values) {
    const std::uint8_t* packed = cell + transport::kBitmapBytes;
    for (std::size_t at = 0; at < transport::kBitmapBytes;
         at += sizeof(__mmask64), values += 64) {
        __mmask64 mask = 0;
        std::memcpy(&mask, cell + at, sizeof(mask));
        const __m512i run = _mm512_loadu_si512(packed);
        _mm512_storeu_si512(values, _mm512_maskz_expand_epi8(mask, run));
        packed += std::popcount(mask);
    }
}

__attribute__((target("avx512vbmi2"))) inline void expand16_by_instruction(
    const std::uint8_t* cell, std::int16_t* values) {
    const std::uint8_t* packed = cell + transport::kBitmapBytes;
    for (std::size_t at = 0; at < transport::kBitmapBytes;
         at += sizeof(__mmask32), values += 32) {
        __mmask32 mask = 0;
        std::memcpy(&mask, cell + at, sizeof(mask));
        const __m512i run = _mm512_loadu_si512(packed);
        _mm512_storeu_si512(values, _mm512_maskz_expand_epi16(mask, run));
        packed += sizeof(std::int16_t) * static_cast<std::size_t>(std::popcount(mask));
    }
}

inline BitmapExpansion best_expansion() {
    if (__builtin_cpu_supports("avx512vbmi2") != 0) {
        return {expand8_by_instruction, expand16_by_instruction};
    }
    return {expand8_by_table, expand16_one_by_one};
}
#else
inline BitmapExpansion best_expansion() {
    return {expand8_by_table, expand16_one_by_one};
}
#endif

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
