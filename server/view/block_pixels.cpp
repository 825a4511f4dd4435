#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/view/block_pixels.cpp"
#include "server/view/block_pixels.h"

#include "protocol/transport/block_basis.h"
#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::view::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using transport::kBlockSize;
using transport::kColours;
using transport::kTileSide;

using Plane = std::array<float, kBlockSize>;

// One level finer: the four children of a place stand where its Z-order says.
template <std::size_t kPlaces>
HWY_INLINE void refine(const float* HWY_RESTRICT averages,
                       const float* HWY_RESTRICT wavelets,
                       float* HWY_RESTRICT finer) {
    constexpr std::size_t kLanes = std::min<std::size_t>(kPlaces, 8);
    const hn::CappedTag<float, kLanes> d;
    const auto half = hn::Set(d, 0.5F);
    for (std::size_t z = 0; z < kPlaces; z += hn::Lanes(d)) {
        const auto a = hn::LoadU(d, averages + z);
        auto h = hn::Zero(d);
        auto v = h;
        auto x = h;
        hn::LoadInterleaved3(d, wavelets + 3 * z, h, v, x);
        const auto left = hn::Add(a, h);
        const auto right = hn::Sub(a, h);
        const auto upper_left = hn::Add(v, x);
        const auto upper_right = hn::Sub(v, x);
        hn::StoreInterleaved4(hn::Mul(half, hn::Add(left, upper_left)),
                              hn::Mul(half, hn::Add(right, upper_right)),
                              hn::Mul(half, hn::Sub(left, upper_left)),
                              hn::Mul(half, hn::Sub(right, upper_right)), d, finer + 4 * z);
    }
}

// Two pixels side by side are neighbours in Z-order too.
HWY_INLINE void rows_from_z_order(const Plane& z_ordered, Plane& rows) {
    // Whole, for then the table is not read but is in the instructions.
#pragma GCC unroll 128
    for (std::size_t slot = 0; slot < kBlockSize; slot += 2) {
        std::memcpy(&rows[slot], &z_ordered[transport::kZOrder[slot]], 2 * sizeof(float));
    }
}

HWY_INLINE void receivers_from(const float* HWY_RESTRICT coefficients, Plane& receivers) {
    Plane finer;
    Plane coarser;
    refine<1>(coefficients, coefficients + 1, finer.data());
    refine<4>(finer.data(), coefficients + 4, coarser.data());
    refine<16>(coarser.data(), coefficients + 16, finer.data());
    refine<64>(finer.data(), coefficients + 64, coarser.data());
    rows_from_z_order(coarser, receivers);
}

// Its planes are read side by side, which no prefetcher of the processor follows; and the sums
// of the next block of the image most likely come next.
HWY_INLINE void prefetch(const float* sums, const float* tint) {
    constexpr std::size_t kBlockFloats = kColours * kBlockSize;
    constexpr std::size_t kLineFloats = 64 / sizeof(float);
    for (std::size_t i = 0; i < kBlockFloats; i += kLineFloats) {
        __builtin_prefetch(tint + i);
        __builtin_prefetch(sums + kBlockFloats + i);
    }
}

void write_tile(const float* HWY_RESTRICT sums,
                const float* HWY_RESTRICT tint,
                std::size_t row_floats,
                float* HWY_RESTRICT out) {
    prefetch(sums, tint);
    std::array<Plane, kColours> planes;
    for (std::size_t c = 0; c < kColours; ++c) {
        receivers_from(sums + c * kBlockSize, planes[c]);
    }
    const hn::CappedTag<float, 8> d;
    for (std::size_t y = 0; y < kTileSide; ++y) {
        for (std::size_t x = 0; x < kTileSide; x += hn::Lanes(d)) {
            const auto colour = [&](std::size_t c) HWY_ATTR {
                const std::size_t slot = y * kTileSide + x;
                return hn::Mul(hn::LoadU(d, &planes[c][slot]),
                               hn::LoadU(d, tint + c * kBlockSize + slot));
            };
            hn::StoreInterleaved3(colour(0), colour(1), colour(2), d,
                                  out + y * row_floats + kColours * x);
        }
    }
}

void write_pixels(const float* sums, const float* tint, const BlockPixels& pixels) {
    if (pixels.columns == kTileSide && pixels.rows == kTileSide) {
        write_tile(sums, tint, pixels.row_floats, pixels.first);
        return;
    }
    // At the image's right and lower edge, where not all of the tile is kept.
    constexpr std::size_t kTileFloats = std::size_t{kColours} * kTileSide;
    std::array<float, kTileFloats * kTileSide> tile;
    write_tile(sums, tint, kTileFloats, tile.data());
    for (std::size_t y = 0; y < pixels.rows; ++y) {
        std::memcpy(pixels.first + y * pixels.row_floats, &tile[y * kTileFloats],
                    kColours * pixels.columns * sizeof(float));
    }
}

}  // namespace
}  // namespace relume::view::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::view {

HWY_EXPORT(write_pixels);

void write_block_pixels(const float* sums, const float* tint, const BlockPixels& pixels) {
    engine::apply_forced_target();
    HWY_DYNAMIC_DISPATCH(write_pixels)(sums, tint, pixels);
}

}  // namespace relume::view
#endif
