// Sixteen sums of three colours that go side by side in vectors, and how they are added up.
// Compiled once per instruction set, as Highway's own "-inl" headers are.
#if defined(RELUME_LANE_SUMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_LANE_SUMS_INL_H
#undef RELUME_LANE_SUMS_INL_H
#else
#define RELUME_LANE_SUMS_INL_H
#endif

#include "server/engine/kernels/lane_sums.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

namespace hn = hwy::HWY_NAMESPACE;

using LaneTag = hn::CappedTag<float, kLaneSums>;
inline constexpr std::size_t kVectorLanes = hn::MaxLanes(LaneTag());
inline constexpr std::size_t kLaneVectors = kLaneSums / kVectorLanes;

// Of three colours, lane by lane.
using LaneVectors = hn::Vec<LaneTag>[3][kLaneVectors];

HWY_INLINE void clear(LaneVectors& sums) {
    for (auto& colour : sums) {
        for (auto& vector : colour) {
            vector = hn::Zero(LaneTag());
        }
    }
}

// As sum_in_halves adds them.
HWY_INLINE std::array<float, 3> added_up(const LaneVectors& sums) {
    std::array<float, 3> radiance{};
    for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
        alignas(64) std::array<float, kLaneSums> lanes;
        for (std::size_t i = 0; i < kLaneVectors; ++i) {
            hn::Store(sums[colour][i], LaneTag(), lanes.data() + i * kVectorLanes);
        }
        radiance[colour] = sum_in_halves(lanes);
    }
    return radiance;
}

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
