// Indirect light by path tracing: where paths that hit something first leave the scene at last.
#pragma once

#include "precompute/bake/ray_caster.h"
#include "precompute/bake/receiver.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::bake {

// A path that left the scene. `texel` is a key that sorts by face, then along a Morton curve
// (texel_key below).
struct Escape {
    std::uint32_t texel = 0;
    Imath::V3f weight{0, 0, 0};  // response per unit radiance, over the surface's reflectance
};

// All paths from one PixelSurface. Response of the surface to radiance L(ω): reflectance ·
// Σ weight · L / paths.
struct SurfacePaths {
    std::vector<Escape> escapes;
    std::uint32_t paths = 0;
    float nearness = 0;  // mean of 1/distance to what the paths hit first, per world unit
    std::uint64_t rays = 0;
};

// What path weights are divided by, so that paths of differently coloured points can be shared:
// the albedo of a Lambert point, for others diffuse plus specular colour.
[[nodiscard]] Imath::V3f reflectance(const scene::Bsdf& bsdf);

[[nodiscard]] constexpr std::uint32_t texel_key(std::uint32_t face_resolution,
                                                std::uint32_t face,
                                                std::uint32_t morton) {
    return face * face_resolution * face_resolution + morton;
}

// Where in basis/cubemap.h the texel of a key lies.
[[nodiscard]] std::size_t texel_index_from_key(std::uint32_t face_resolution,
                                               std::uint32_t key);

class PathTracer {
  public:
    // `bounces`: scattering events after the first surface, at least 1.
    PathTracer(const RayCaster& caster,
               std::uint32_t face_resolution,
               std::uint32_t bounces,
               std::uint32_t samples,
               std::uint64_t seed)
        : caster_(caster),
          face_resolution_(face_resolution),
          bounces_(bounces),
          samples_(samples),
          seed_(seed) {}

    // Paths of one surface of pixel (x, y): its share of `samples`, at least one.
    // Low-discrepancy within the pixel and across neighbouring pixels [Ahmed20]. Depends on
    // nothing but its arguments.
    [[nodiscard]] SurfacePaths trace(const PixelSurface& surface,
                                     std::uint32_t surface_number,
                                     std::uint32_t x,
                                     std::uint32_t y) const;

  private:
    void trace_path(const PixelSurface& surface,
                    std::uint32_t index,
                    std::uint64_t key,
                    SurfacePaths& paths) const;
    void record(const Imath::V3f& direction,
                const Imath::V3f& weight,
                SurfacePaths& paths) const;

    const RayCaster& caster_;
    std::uint32_t face_resolution_;
    std::uint32_t bounces_;
    std::uint32_t samples_;
    std::uint64_t seed_;
};

}  // namespace relume::bake
