// Sums over open texels for every instruction set Highway knows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/open_texels.cpp"
#include "server/engine/kernels/open_texels.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>
// Once for each instruction set, hence after foreach_target.h.
#include "server/engine/kernels/lane_sums-inl.h"

#include <algorithm>
#include <cmath>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void sum_open_loop(const std::uint64_t* open,
                   std::size_t words,
                   const ColourPlanes& planes,
                   const float* factor,
                   float* sums) {
    const std::span<const std::uint64_t> bits(open, words);
    const auto radiance = factor == nullptr ? sum_open_scalar(bits, planes)
                                            : sum_open_products_scalar(bits, planes, factor);
    for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
        sums[colour] = radiance[colour];
    }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// `factor` may be null: then it is 1.
template <bool kHasFactor>
HWY_INLINE void sum_open_of(const std::uint64_t* HWY_RESTRICT open,
                            std::size_t words,
                            const ColourPlanes& planes,
                            const float* HWY_RESTRICT factor,
                            float* HWY_RESTRICT sums) {
    const LaneTag d;
    LaneVectors partial;
    clear(partial);
    for (std::size_t word = 0; word < words; ++word) {
        const std::uint64_t bits = open[word];
        if (bits == 0) {
            continue;
        }
        for (std::size_t first = 0; first < 64; first += kLaneSums) {
            for (std::size_t i = 0; i < kLaneVectors; ++i) {
                const std::size_t lane = first + i * kVectorLanes;
                const std::uint64_t of_vector = bits >> lane;
                std::uint8_t mask_bytes[8];
                std::memcpy(mask_bytes, &of_vector, sizeof(mask_bytes));
                const auto mask = hn::LoadMaskBits(d, mask_bytes);
                const std::size_t texel = 64 * word + lane;
                for (std::size_t colour = 0; colour < 3; ++colour) {
                    const auto value = hn::LoadU(d, planes[colour] + texel);
                    auto& sum = partial[colour][i];
                    if constexpr (kHasFactor) {
                        const auto open_factor =
                            hn::IfThenElseZero(mask, hn::LoadU(d, factor + texel));
                        sum = hn::MulAdd(value, open_factor, sum);
                    } else {
                        sum = hn::Add(sum, hn::IfThenElseZero(mask, value));
                    }
                }
            }
        }
    }
    const std::array<float, 3> radiance = added_up(partial);
    std::copy(radiance.begin(), radiance.end(), sums);
}

void sum_open_loop(const std::uint64_t* open,
                   std::size_t words,
                   const ColourPlanes& planes,
                   const float* factor,
                   float* sums) {
    if (factor == nullptr) {
        sum_open_of<false>(open, words, planes, nullptr, sums);
    } else {
        sum_open_of<true>(open, words, planes, factor, sums);
    }
}

#endif
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {
namespace {

HWY_EXPORT(sum_open_loop);

// One at a time; `factor_of(texel)` is 1 or what the value is multiplied with.
template <typename AddOpen>
std::array<float, 3> sum_one_by_one(std::span<const std::uint64_t> open,
                                    const ColourPlanes& planes,
                                    AddOpen add_open) {
    std::array<float, 3> radiance{};
    for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
        std::array<float, kLaneSums> sums{};
        for (std::size_t texel = 0; texel < 64 * open.size(); ++texel) {
            if ((open[texel / 64] >> texel % 64 & 1U) != 0) {
                sums[texel % kLaneSums] =
                    add_open(sums[texel % kLaneSums], planes[colour][texel], texel);
            }
        }
        radiance[colour] = sum_in_halves(sums);
    }
    return radiance;
}

}  // namespace

std::array<float, 3> sum_open_scalar(std::span<const std::uint64_t> open,
                                     const ColourPlanes& planes) {
    return sum_one_by_one(open, planes, [](float sum, float value, std::size_t /*texel*/) {
        return sum + value;
    });
}

std::array<float, 3> sum_open_products_scalar(std::span<const std::uint64_t> open,
                                              const ColourPlanes& planes,
                                              const float* factor) {
    return sum_one_by_one(open, planes, [&](float sum, float value, std::size_t texel) {
        return std::fma(value, factor[texel], sum);
    });
}

std::array<float, 3> sum_open(std::span<const std::uint64_t> open, const ColourPlanes& planes) {
    if (scalar_is_forced()) {
        return sum_open_scalar(open, planes);
    }
    apply_forced_target();
    std::array<float, 3> radiance{};
    HWY_DYNAMIC_DISPATCH(sum_open_loop)
    (open.data(), open.size(), planes, nullptr, radiance.data());
    return radiance;
}

std::array<float, 3> sum_open_products(std::span<const std::uint64_t> open,
                                       const ColourPlanes& planes,
                                       const float* factor) {
    if (scalar_is_forced()) {
        return sum_open_products_scalar(open, planes, factor);
    }
    apply_forced_target();
    std::array<float, 3> radiance{};
    HWY_DYNAMIC_DISPATCH(sum_open_loop)
    (open.data(), open.size(), planes, factor, radiance.data());
    return radiance;
}

}  // namespace relume::engine
#endif
