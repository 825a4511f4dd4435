// The triple product of one receiver for every instruction set Highway knows.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/triple_product_simd.cpp"
#include "protocol/basis/cubemap.h"
#include "server/engine/kernels/target.h"
#include "server/engine/kernels/triple_product.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void multiply_visibility_loop(const tripling::VisibilityView& visibility,
                              std::span<const WeightedWavelets> material,
                              std::span<const std::uint64_t> light_terms,
                              TripleWorkspace& workspace) {
    multiply_visibility_scalar(visibility, material, light_terms, workspace);
}

Radiance sum_light_loop(const LightTable& light, const TripleWorkspace& workspace) {
    return sum_light_scalar(light, workspace);
}

#else

namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct VectorLanes {
    using D = hn::CappedTag<float, 4>;
    using V = hn::Vec<D>;

    static HWY_INLINE V load(const float* from) { return hn::LoadU(D(), from); }
    static HWY_INLINE void store(V v, float* to) { hn::StoreU(v, D(), to); }
    static HWY_INLINE V set(float value) { return hn::Set(D(), value); }
    static HWY_INLINE V signs(float a, float b, float c, float d) {
        alignas(16) const float values[4] = {a, b, c, d};
        return hn::Load(D(), values);
    }
    static HWY_INLINE V mul(V a, V b) { return hn::Mul(a, b); }
    static HWY_INLINE V fused(V a, V b, V c) { return hn::MulAdd(a, b, c); }
    template <std::size_t kXor>
    static HWY_INLINE V exchange(V v) {
        if constexpr (kXor == 1) {
            return hn::Shuffle2301(v);
        } else if constexpr (kXor == 2) {
            return hn::Shuffle1032(v);
        } else {
            return hn::Shuffle0123(v);
        }
    }
    static HWY_INLINE V with_first(V v, float first) { return hn::InsertLane(v, 0, first); }
};

#define RELUME_WALK_INLINE HWY_INLINE
#include "server/engine/kernels/triple_walk-inl.h"
#undef RELUME_WALK_INLINE

}  // namespace

void multiply_visibility_loop(const tripling::VisibilityView& visibility,
                              std::span<const WeightedWavelets> material,
                              std::span<const std::uint64_t> light_terms,
                              TripleWorkspace& workspace) {
    walk_receiver<VectorLanes>(visibility, material, light_terms, workspace);
}

// A row of the table is one vector, or two or four of them; a block of four lanes goes with one
// of the product's lanes.
Radiance sum_light_loop(const LightTable& light, const TripleWorkspace& workspace) {
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    constexpr std::size_t kLanes = hn::MaxLanes(d);
    constexpr std::size_t kVectors = 16 / kLanes;
    hn::Vec<decltype(d)> even[kVectors], odd[kVectors];
    hn::Vec<hn::RebindToSigned<decltype(d)>> pick[kVectors];
    for (std::size_t i = 0; i < kVectors; ++i) {
        even[i] = odd[i] = hn::Zero(d);
        // Within its block of four copies of the product, lane b of block b.
        alignas(64) std::int32_t indices[kLanes];
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            indices[lane] = static_cast<std::int32_t>(lane / 4 * 4 + (i * kLanes + lane) / 4);
        }
        pick[i] = hn::Load(di, indices);
    }
    const float* HWY_RESTRICT rows = light.rows();
    const auto squares = workspace.squares();
    const float* HWY_RESTRICT products =
        squares.empty() ? nullptr : workspace.products()[0].data();
    const auto add = [&](std::size_t place, auto& sums) HWY_ATTR {
        const auto product = hn::LoadDup128(d, products + 4 * place);
        const float* row = rows + std::size_t{16} * squares[place];
        for (std::size_t i = 0; i < kVectors; ++i) {
            const auto lane = hn::TableLookupLanes(product, hn::IndicesFromVec(d, pick[i]));
            sums[i] = hn::MulAdd(lane, hn::LoadU(d, row + i * kLanes), sums[i]);
        }
    };
    std::size_t place = 0;
    for (; place + 2 <= squares.size(); place += 2) {
        add(place, even);
        add(place + 1, odd);
    }
    if (place < squares.size()) {
        add(place, even);
    }
    alignas(64) float lanes[16];  // [lane][colour]
    for (std::size_t i = 0; i < kVectors; ++i) {
        hn::StoreU(hn::Add(even[i], odd[i]), d, lanes + i * kLanes);
    }
    Radiance radiance{};
    for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
        radiance[colour] =
            (lanes[colour] + lanes[4 + colour]) + (lanes[8 + colour] + lanes[12 + colour]);
    }
    return radiance;
}

#endif
}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(multiply_visibility_loop);
HWY_EXPORT(sum_light_loop);

void multiply_visibility(const tripling::VisibilityView& visibility,
                         std::span<const WeightedWavelets> material,
                         std::span<const std::uint64_t> light_terms,
                         TripleWorkspace& workspace) {
    if (scalar_is_forced()) {
        multiply_visibility_scalar(visibility, material, light_terms, workspace);
        return;
    }
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(multiply_visibility_loop)
    (visibility, material, light_terms, workspace);
}

Radiance sum_light(const LightTable& light, const TripleWorkspace& workspace) {
    if (scalar_is_forced()) {
        return sum_light_scalar(light, workspace);
    }
    apply_forced_target();
    return HWY_DYNAMIC_DISPATCH(sum_light_loop)(light, workspace);
}

}  // namespace relume::engine
#endif
