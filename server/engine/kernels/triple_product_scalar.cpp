#include "protocol/basis/cubemap.h"
#include "server/engine/kernels/triple_product.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace relume::engine {
namespace {

// A vector of four floats, one at a time.
struct ScalarLanes {
    using V = std::array<float, 4>;

    static V load(const float* from) { return {from[0], from[1], from[2], from[3]}; }
    static void store(const V& v, float* to) { std::copy(v.begin(), v.end(), to); }
    static V set(float value) { return {value, value, value, value}; }
    static V signs(float a, float b, float c, float d) { return {a, b, c, d}; }
    static V mul(const V& a, const V& b) {
        return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
    }
    static V fused(const V& a, const V& b, const V& c) {
        return {std::fma(a[0], b[0], c[0]), std::fma(a[1], b[1], c[1]),
                std::fma(a[2], b[2], c[2]), std::fma(a[3], b[3], c[3])};
    }
    template <std::size_t kXor>
    static V exchange(const V& v) {
        return {v[0 ^ kXor], v[1 ^ kXor], v[2 ^ kXor], v[3 ^ kXor]};
    }
    static V with_first(const V& v, float first) { return {first, v[1], v[2], v[3]}; }
};

#define RELUME_WALK_INLINE inline
#include "server/engine/kernels/triple_walk-inl.h"
#undef RELUME_WALK_INLINE

}  // namespace

TripleWorkspace::TripleWorkspace(std::uint32_t n)
    : n_(n),
      face_{.material = std::vector<ProductLanes>(tripling::face_stride(n)),
            .material_means = std::vector<float>(tripling::face_stride(n) + 1),
            .visible_means = std::vector<float>(tripling::face_stride(n) + 1),
            .kept = std::vector<std::uint64_t>(tripling::face_stride(n) / tripling::kWordBits)},
      // A square of the material, one of the light, and the mean of each face.
      squares_(2 * tripling::square_stride(n) + basis::kFaceCount),
      products_(squares_.size()) {}

void multiply_visibility_scalar(const tripling::VisibilityView& visibility,
                                std::span<const WeightedWavelets> material,
                                std::span<const std::uint64_t> light_terms,
                                TripleWorkspace& workspace) {
    walk_receiver<ScalarLanes>(visibility, material, light_terms, workspace);
}

Radiance sum_light_scalar(const LightTable& light, const TripleWorkspace& workspace) {
    std::array<std::array<std::array<float, 3>, 4>, 2> sums{};  // [even, odd][lane][colour]
    for (std::size_t i = 0; i < workspace.squares().size(); ++i) {
        const float* row = light.row(workspace.squares()[i]);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            for (std::size_t colour = 0; colour < 3; ++colour) {
                float& sum = sums[i % 2][lane][colour];
                sum = std::fma(workspace.products()[i][lane], row[4 * lane + colour], sum);
            }
        }
    }
    Radiance radiance{};
    for (std::size_t colour = 0; colour < 3; ++colour) {
        std::array<float, 4> lanes{};
        for (std::size_t lane = 0; lane < 4; ++lane) {
            lanes[lane] = sums[0][lane][colour] + sums[1][lane][colour];
        }
        radiance[colour] = (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
    }
    return radiance;
}

}  // namespace relume::engine
