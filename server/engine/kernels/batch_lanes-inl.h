// Sums of several sessions side by side: three lanes each, one for a colour. Compiled once per
// instruction set, as Highway's own "-inl" headers are.
#if defined(RELUME_BATCH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_BATCH_LANES_INL_H
#undef RELUME_BATCH_LANES_INL_H
#else
#define RELUME_BATCH_LANES_INL_H
#endif

#include "server/engine/kernels/accumulate_batch.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // which runs the specification

inline constexpr std::size_t kMaxLanes = transport::kColours * kMaxBatchMembers;
using LaneTag = hwy::HWY_NAMESPACE::CappedTag<float, 16>;
using LaneVector = hwy::HWY_NAMESPACE::Vec<LaneTag>;
inline constexpr std::size_t kVectorLanes = hwy::HWY_NAMESPACE::MaxLanes(LaneTag());
inline constexpr std::size_t kMaxVectors = kMaxLanes / kVectorLanes;
static_assert(kMaxLanes % kVectorLanes == 0);

// Weights of one segment for all lanes, 0 for those of members that do not take it.
using LaneWeights = std::array<float, kMaxLanes>;

// The vectors of lanes in which any weight is not zero, with their weights in registers.
template <std::size_t kActive>
struct ActiveLanes {
    LaneVector weights[kActive];
    std::size_t offsets[kActive];

    HWY_INLINE void add(float value, float* HWY_RESTRICT sums) const {
        const LaneTag df;
        const auto v = hwy::HWY_NAMESPACE::Set(df, value);
        for (std::size_t i = 0; i < kActive; ++i) {
            float* HWY_RESTRICT at = sums + offsets[i];
            hwy::HWY_NAMESPACE::Store(
                hwy::HWY_NAMESPACE::MulAdd(weights[i], v, hwy::HWY_NAMESPACE::Load(df, at)), df,
                at);
        }
    }
};

// Calls `body` with the segment's ActiveLanes, its number of vectors a constant.
template <std::size_t kActive = kMaxVectors, typename Body>
HWY_INLINE void with_active_lanes(const LaneWeights& weights,
                                  const std::array<std::uint8_t, kMaxVectors>& active,
                                  std::size_t active_count,
                                  float scale,
                                  const Body& body) {
    if constexpr (kActive > 0) {
        if (active_count == kActive) {
            const LaneTag df;
            ActiveLanes<kActive> lanes;
            for (std::size_t i = 0; i < kActive; ++i) {
                lanes.offsets[i] = active[i] * kVectorLanes;
                lanes.weights[i] = hwy::HWY_NAMESPACE::Mul(
                    hwy::HWY_NAMESPACE::Set(df, scale),
                    hwy::HWY_NAMESPACE::LoadU(df, weights.data() + lanes.offsets[i]));
            }
            body(lanes);
            return;
        }
        with_active_lanes<kActive - 1>(weights, active, active_count, scale, body);
    }
}

// The sums of one block in all lanes, [256][stride], zero but where something was added since
// they were last taken; rows of 16 slots in which that is so are remembered.
class LaneSums {
  public:
    static constexpr std::size_t kRowSlots = 16;

    [[nodiscard]] HWY_INLINE float* slot(std::size_t slot, std::size_t stride) {
        return sums_.data() + slot * stride;
    }
    void touch_row_of(std::size_t slot) { touched_ |= std::uint32_t{1} << (slot / kRowSlots); }
    void touch_rows(std::uint32_t rows) { touched_ |= rows; }

    // Adds another's sums, which are zero then.
    void absorb(LaneSums& other, std::size_t stride) {
        const LaneTag df;
        for (std::uint32_t rows = other.touched_; rows != 0; rows &= rows - 1) {
            const std::size_t row = static_cast<std::size_t>(std::countr_zero(rows));
            float* HWY_RESTRICT to = slot(row * kRowSlots, stride);
            float* HWY_RESTRICT from = other.slot(row * kRowSlots, stride);
            for (std::size_t i = 0; i < kRowSlots * stride; i += kVectorLanes) {
                namespace hn = hwy::HWY_NAMESPACE;
                hn::Store(hn::Add(hn::Load(df, to + i), hn::Load(df, from + i)), df, to + i);
                hn::Store(hn::Zero(df), df, from + i);
            }
        }
        touched_ |= other.touched_;
        other.touched_ = 0;
    }

    // Adds the sums of every member to its targets in this block, and is zero again.
    void take(std::span<const BatchMember> members, std::size_t block, std::size_t stride) {
        if (touched_ == 0) {
            return;
        }
        for (std::size_t lane = 0; lane < transport::kColours * members.size(); lane += 4) {
            take_four(members, block, stride, lane);
        }
        touched_ = 0;
    }

  private:
    static constexpr std::size_t kSumsPerBlock = transport::kColours * transport::kBlockSize;
    using FourTag = hwy::HWY_NAMESPACE::FixedTag<float, 4>;
    using Four = hwy::HWY_NAMESPACE::Vec<FourTag>;

    // Where a lane's values of one block go; null for lanes beyond the members.
    struct Planes {
        std::array<float*, 4> sums{};
        std::array<float*, 4> totals{};
    };

    static Planes planes_of(std::span<const BatchMember> members,
                            std::size_t block,
                            std::size_t first_lane) {
        Planes planes;
        for (std::size_t i = 0; i < planes.sums.size(); ++i) {
            const std::size_t member = (first_lane + i) / transport::kColours;
            if (member < members.size()) {
                const std::size_t first = block * kSumsPerBlock + (first_lane + i) %
                                                                      transport::kColours *
                                                                      transport::kBlockSize;
                const SumTargets& targets = members[member].targets;
                planes.sums[i] = targets.sums + first;
                planes.totals[i] = targets.total == nullptr ? nullptr : targets.total + first;
            }
        }
        return planes;
    }

    static HWY_INLINE void add(Four values, float* target) {
        if (target != nullptr) {
            const FourTag d4;
            hwy::HWY_NAMESPACE::StoreU(
                hwy::HWY_NAMESPACE::Add(hwy::HWY_NAMESPACE::LoadU(d4, target), values), d4,
                target);
        }
    }

    // Four lanes of every touched row, from a slot's lanes side by side to a lane's slots.
    HWY_INLINE void take_four(std::span<const BatchMember> members,
                              std::size_t block,
                              std::size_t stride,
                              std::size_t first_lane) {
        namespace hn = hwy::HWY_NAMESPACE;
        const FourTag d4;
        const Planes planes = planes_of(members, block, first_lane);
        for (std::size_t slot = 0; slot < transport::kBlockSize; slot += 4) {
            if (((touched_ >> (slot / kRowSlots)) & 1U) == 0) {
                continue;
            }
            float* HWY_RESTRICT from = sums_.data() + slot * stride + first_lane;
            const Four a = hn::Load(d4, from);
            const Four b = hn::Load(d4, from + stride);
            const Four c = hn::Load(d4, from + 2 * stride);
            const Four d = hn::Load(d4, from + 3 * stride);
            for (std::size_t i = 0; i < 4; ++i) {
                hn::Store(hn::Zero(d4), d4, from + i * stride);
            }
            const Four ac_lower = hn::InterleaveLower(d4, a, c);
            const Four bd_lower = hn::InterleaveLower(d4, b, d);
            const Four ac_upper = hn::InterleaveUpper(d4, a, c);
            const Four bd_upper = hn::InterleaveUpper(d4, b, d);
            const Four lanes[] = {hn::InterleaveLower(d4, ac_lower, bd_lower),
                                  hn::InterleaveUpper(d4, ac_lower, bd_lower),
                                  hn::InterleaveLower(d4, ac_upper, bd_upper),
                                  hn::InterleaveUpper(d4, ac_upper, bd_upper)};
            for (std::size_t i = 0; i < 4; ++i) {
                if (planes.sums[i] != nullptr) {
                    add(lanes[i], planes.sums[i] + slot);
                }
                if (planes.totals[i] != nullptr) {
                    add(lanes[i], planes.totals[i] + slot);
                }
            }
        }
    }

    alignas(64) std::array<float, transport::kBlockSize * kMaxLanes> sums_{};
    std::uint32_t touched_ = 0;
};

#endif  // HWY_SCALAR
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
