// Sums over open texels times a mixture, for every instruction set Highway knows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/open_mixture.cpp"
#include "server/engine/kernels/open_mixture.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>
// Once for each instruction set, hence after foreach_target.h.
#include "server/engine/kernels/lane_sums-inl.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

std::array<float, 3> sum_open_mixture_loop(std::span<const std::uint64_t> open,
                                           const ColourPlanes& planes,
                                           std::span<const WeightedTexels> functions) {
    return sum_open_mixture_scalar(open, planes, functions);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

std::array<float, 3> sum_open_mixture_loop(std::span<const std::uint64_t> open,
                                           const ColourPlanes& planes,
                                           std::span<const WeightedTexels> functions) {
    constexpr std::size_t kRunVectors = tripling::kRunTexels / kVectorLanes;
    const LaneTag d;
    LaneVectors sums;
    clear(sums);
    for (std::size_t word = 0; 64 * word < open.size(); ++word) {
        std::uint64_t any = 0;
        for (const WeightedTexels& part : functions) {
            any |= part.function.words[word];
        }
        for (; any != 0; any &= any - 1) {
            const std::size_t run = 64 * word + static_cast<std::size_t>(std::countr_zero(any));
            const std::uint64_t bits = open[run];
            if (bits == 0) {
                continue;
            }
            // All of the run at a time, so that no sum waits for the one before.
            hn::Vec<LaneTag> mixed[kRunVectors];
            for (auto& vector : mixed) {
                vector = hn::Zero(d);
            }
            for (const WeightedTexels& part : functions) {
                const float* of_run = tripling::values_of_run(part.function, run);
                if (of_run == nullptr) {
                    continue;
                }
                const auto weight = hn::Set(d, part.weight);
                for (std::size_t i = 0; i < kRunVectors; ++i) {
                    mixed[i] =
                        hn::MulAdd(weight, hn::LoadU(d, of_run + i * kVectorLanes), mixed[i]);
                }
            }
            for (std::size_t i = 0; i < kRunVectors; ++i) {
                const std::size_t lane = i * kVectorLanes;
                const std::uint64_t of_vector = bits >> lane;
                std::uint8_t mask_bytes[8];
                std::memcpy(mask_bytes, &of_vector, sizeof(mask_bytes));
                const auto open_part =
                    hn::IfThenElseZero(hn::LoadMaskBits(d, mask_bytes), mixed[i]);
                const std::size_t texel = tripling::kRunTexels * run + lane;
                for (std::size_t colour = 0; colour < 3; ++colour) {
                    auto& sum = sums[colour][i % kLaneVectors];
                    sum = hn::MulAdd(hn::LoadU(d, planes[colour] + texel), open_part, sum);
                }
            }
        }
    }
    return added_up(sums);
}

#endif
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {
namespace {

HWY_EXPORT(sum_open_mixture_loop);

}  // namespace

std::array<float, 3> sum_open_mixture_scalar(std::span<const std::uint64_t> open,
                                             const ColourPlanes& planes,
                                             std::span<const WeightedTexels> functions) {
    std::array<std::array<float, kLaneSums>, 3> sums{};
    for (std::size_t texel = 0; texel < 64 * open.size(); ++texel) {
        if ((open[texel / 64] >> texel % 64 & 1U) == 0) {
            continue;
        }
        float mixed = 0;
        for (const WeightedTexels& part : functions) {
            if (const float* values = tripling::values_of_run(part.function, texel / 64)) {
                mixed = std::fma(part.weight, values[texel % 64], mixed);
            }
        }
        for (std::size_t colour = 0; colour < sums.size(); ++colour) {
            float& sum = sums[colour][texel % kLaneSums];
            sum = std::fma(planes[colour][texel], mixed, sum);
        }
    }
    std::array<float, 3> radiance{};
    for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
        radiance[colour] = sum_in_halves(sums[colour]);
    }
    return radiance;
}

std::array<float, 3> sum_open_mixture(std::span<const std::uint64_t> open,
                                      const ColourPlanes& planes,
                                      std::span<const WeightedTexels> functions) {
    if (scalar_is_forced()) {
        return sum_open_mixture_scalar(open, planes, functions);
    }
    apply_forced_target();
    return HWY_DYNAMIC_DISPATCH(sum_open_mixture_loop)(open, planes, functions);
}

}  // namespace relume::engine
#endif
