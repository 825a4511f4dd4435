// Points of one material, and how it shows the eye what they have been given.
#pragma once

#include "server/view/mesh/drawn_surface.h"
#include "server/view/mesh/pixel_rays.h"
#include "server/view/mesh/raster_tile.h"
#include "server/view/mesh/visible_surface.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::view {

// Takes points until it is full, then writes the weights of all their terms. What lies below
// the horizon of an interpolated normal is seen along the horizon, so that silhouettes of round
// things have no dark rims. Not thread-safe.
class ShadedPoints {
  public:
    static constexpr std::size_t kMost = 64;

    // Without points. Keeps a reference to the surface.
    void begin(const DrawnSurface& surface, std::uint32_t material, const PixelRays& rays);
    [[nodiscard]] bool is_full() const { return count_ == kMost; }
    // `pixel` is its place in the image; weights go to [terms][4].
    void add(const SurfacePoint& point, const SamplePosition& pixel, float* weights);
    // Of all points, which it then has no longer.
    void write_weights();

  private:
    using Plane = std::array<float, kMost>;
    struct alignas(64) Planes {
        Plane x, y, z;
    };

    [[nodiscard]] Imath::V3f colour_at(std::size_t point, const DrawnLobe& lobe) const;
    void find_texture_sides(const SurfacePoint& point, const Imath::V3f& ray);

    const DrawnSurface* surface_ = nullptr;
    const DrawnMaterial* material_ = nullptr;
    PixelRays rays_;
    std::size_t count_ = 0;
    std::array<float*, kMost> weights_{};
    Planes normals_;
    Planes towards_eye_;
    Planes local_;
    std::vector<float> h_;  // [points][terms][lobes]
    // Of materials with textures: where the point is, and what a pixel spans there.
    std::array<Imath::V2f, kMost> uv_{};
    std::array<Imath::V2f, kMost> uv_across_{};
    std::array<Imath::V2f, kMost> uv_along_{};
};

}  // namespace relume::view
