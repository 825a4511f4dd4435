// SurfacePoint::reflect over planes of directions; compiled to vectorise (see CMakeLists.txt).
#include "precompute/scene/surface_point.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace relume::scene {
namespace {

constexpr std::size_t kChunk = 256;

}  // namespace

void SurfacePoint::reflect(const Directions& wi_world, const RgbPlanes& out) const {
    const std::size_t count = wi_world.x.size();
    const auto& [s, t, n] = shading;
    const Imath::V3f g = geometric_normal;
    std::array<float, kChunk> x;
    std::array<float, kChunk> y;
    std::array<float, kChunk> z;
    for (std::size_t start = 0; start < count; start += kChunk) {
        const std::size_t size = std::min(kChunk, count - start);
        const float* wx = wi_world.x.data() + start;
        const float* wy = wi_world.y.data() + start;
        const float* wz = wi_world.z.data() + start;
        for (std::size_t i = 0; i < size; ++i) {
            const float above = g.x * wx[i] + g.y * wy[i] + g.z * wz[i];
            const float cosine = n.x * wx[i] + n.y * wy[i] + n.z * wz[i];
            x[i] = s.x * wx[i] + s.y * wy[i] + s.z * wz[i];
            y[i] = t.x * wx[i] + t.y * wy[i] + t.z * wz[i];
            z[i] = above > 0 ? cosine : 0.0F;  // cosine 0 reflects nothing
        }
        bsdf.evaluate_times_cosine(
            wo, {.x = {x.data(), size}, .y = {y.data(), size}, .z = {z.data(), size}},
            {.r = out.r.subspan(start, size),
             .g = out.g.subspan(start, size),
             .b = out.b.subspan(start, size)});
    }
}

}  // namespace relume::scene
