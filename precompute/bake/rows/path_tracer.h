// Indirect light by path tracing: where paths that hit something first leave the scene at last.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/receiver.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <vector>

namespace relume::bake {

// Directions of one weight in which paths left the scene.
struct Escapes {
    Imath::V3f weight{0, 0, 0};  // response per unit radiance, over the surface's reflectance
    std::uint32_t count = 0;
};

// How a path begins: where it goes from the surface, and which escape is the first of it.
struct PathStart {
    Imath::V3f direction{0, 0, 0};  // unit
    std::uint32_t first_escape = 0;
};

// All paths from one surface of a receiver. Response of the surface to radiance L(ω):
// reflectance · Σ weight · L / paths, over the texels of all escapes.
struct SurfacePaths {
    std::vector<Escapes> escapes;
    // One after another, as many as the escapes count: keys that sort by face, then along a
    // Morton curve (texel_key below).
    std::vector<std::uint32_t> texels;
    // Of paths whose light is weighted by where it comes from, in the order of their escapes:
    // kept where the surface has a factored BRDF.
    std::vector<PathStart> starts;
    std::uint32_t paths = 0;
    float nearness = 0;  // mean of 1/distance to what the paths hit first, per world unit
    std::uint64_t rays = 0;
};

// A receiver and where light comes to it from.
struct TracedReceiver {
    Receiver receiver;
    std::vector<SurfacePaths> paths;  // one per surface; none when the bake has no bounces
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

// A path looks at the sky from its vertices in several directions at once: what it costs to get
// there is most of a path's cost, and a small bright light is found by chance. One direction
// more goes on to the next vertex. Where paths are many they look less, and at last that one
// direction is all there is.
class PathTracer {
  public:
    // In how many directions a path looks at scattering event `event`, the receiver's own
    // surface being event 0: none, or more than one.
    [[nodiscard]] static std::uint32_t looks(std::uint32_t event, std::uint32_t samples);
    // What is kept of a receiver's paths at most, in bytes.
    [[nodiscard]] static std::uint64_t most_bytes(std::uint32_t bounces, std::uint32_t samples);

    // `bounces`: scattering events after the first surface; 0: no paths.
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

    PathTracer(const RayCaster& caster, const BakeParameters& parameters)
        : PathTracer(caster,
                     parameters.face_resolution,
                     parameters.bounces,
                     parameters.samples,
                     parameters.seed) {}

    // Paths of all surfaces. Depends on nothing but its argument.
    [[nodiscard]] TracedReceiver trace(Receiver receiver) const;
    // Paths of one surface: its share of `samples`, at least one. Low-discrepancy within the
    // receiver and across its neighbours (SequencePlace).
    [[nodiscard]] SurfacePaths trace_surface(const ReceiverSurface& surface,
                                             const SequencePlace& place) const;

  private:
    // Path `number` of the surface, at `index` of the sequences.
    void trace_path(const ReceiverSurface& surface,
                    std::uint32_t number,
                    std::uint32_t index,
                    std::uint64_t key,
                    SurfacePaths& paths) const;
    // Records the directions, of `looks` that the point scatters to, that leave the scene.
    void look_at_sky(const scene::SurfacePoint& point,
                     const Imath::V3f& weight,
                     std::uint32_t looks,
                     std::uint32_t index,
                     std::uint64_t dimension,
                     SurfacePaths& paths) const;
    [[nodiscard]] std::uint32_t key_from_direction(const Imath::V3f& direction) const;

    const RayCaster& caster_;
    std::uint32_t face_resolution_;
    std::uint32_t bounces_;
    std::uint32_t samples_;
    std::uint64_t seed_;
};

}  // namespace relume::bake
