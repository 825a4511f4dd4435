// A point where a ray met the scene, ready to be lit.
#pragma once

#include "precompute/scene/bsdf.h"
#include "precompute/scene/scene.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::scene {

// Orthonormal, right-handed.
struct Frame {
    Imath::V3f tangent{1, 0, 0};
    Imath::V3f bitangent{0, 1, 0};
    Imath::V3f normal{0, 0, 1};

    // Any tangents will do: the models are isotropic [Duff17].
    [[nodiscard]] static Frame from_normal(const Imath::V3f& unit_normal);
    [[nodiscard]] Imath::V3f to_local(const Imath::V3f& world) const;
    [[nodiscard]] Imath::V3f to_world(const Imath::V3f& local) const;
};

struct SurfacePoint {
    Imath::V3f position{0, 0, 0};
    Imath::V3f geometric_normal{0, 0, 1};  // unit, on the viewer's side
    float reach = 0;  // largest coordinate of its triangle: what rounding moves the point by
    Frame shading;    // its normal on the viewer's side too
    Imath::V3f wo{0, 0, 1};  // to the viewer, shading frame, wo.z > 0
    Bsdf bsdf = Bsdf::lambert({0, 0, 0});

    // Light from below the geometric surface contributes nothing, whatever the interpolated
    // normal says.
    [[nodiscard]] bool is_above_surface(const Imath::V3f& wi_world) const {
        return wi_world.dot(geometric_normal) > 0;
    }
    // f(wi, wo)·cos θi; zero below the geometric or the shading horizon.
    [[nodiscard]] Imath::V3f reflect(const Imath::V3f& wi_world) const;
    // The same for many world directions. Planes of equal length, any alignment.
    void reflect(const Directions& wi_world, const RgbPlanes& out) const;

    struct Sample {
        Imath::V3f wi{0, 0, 0};      // world
        Imath::V3f weight{0, 0, 0};  // f cos θi / pdf; zero: the path ends here
        float pdf = 0;
    };
    [[nodiscard]] Sample sample(float u_lobe, const Imath::V2f& u) const;
    [[nodiscard]] float pdf(const Imath::V3f& wi_world) const;
};

// `barycentric` weighs the triangle's second and third vertex (Embree's u, v);
// `ray_direction` need not be unit and points at the surface. An interpolated or mapped normal
// that faces away from the viewer is bent until the viewer is just above its horizon.
[[nodiscard]] SurfacePoint surface_point(const Scene& scene,
                                         std::uint32_t mesh,
                                         std::uint32_t triangle,
                                         const Imath::V2f& barycentric,
                                         const Imath::V3f& ray_direction);

// False where the surface has a hole at this point (glTF alphaMode MASK) and a ray goes on.
[[nodiscard]] bool is_solid_at(const Scene& scene,
                               std::uint32_t mesh,
                               std::uint32_t triangle,
                               const Imath::V2f& barycentric);
// Whether any material has holes; else no ray needs is_solid_at.
[[nodiscard]] bool has_holes(const Scene& scene);

}  // namespace relume::scene
