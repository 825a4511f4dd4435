// Ray queries on a scene, one ray at a time, and the surface where a ray hits.
#pragma once

#include "precompute/scene/scene.h"
#include "tests/support/reference_tracer/reflection.h"

#include <Imath/ImathVec.h>
#include <embree3/rtcore.h>

#include <memory>
#include <optional>

namespace relume::reference {

struct Surface {
    Imath::V3d position{0, 0, 0};
    Imath::V3d face_normal{0, 0, 1};  // on the viewer's side
    Reflection reflection;
};

// Thread-safe after construction. The scene must outlive it.
class Geometry {
  public:
    explicit Geometry(const scene::Scene& scene);

    [[nodiscard]] std::optional<Surface> surface(const Imath::V3d& origin,
                                                 const Imath::V3d& direction) const;
    [[nodiscard]] bool sees_sky(const Imath::V3d& origin, const Imath::V3d& direction) const;
    // `position` moved off its surface, to the side of `direction`.
    [[nodiscard]] Imath::V3d origin_beside(const Surface& surface,
                                           const Imath::V3d& direction) const;

  private:
    struct Hit {
        unsigned mesh;
        unsigned triangle;
        double b1, b2;
    };
    [[nodiscard]] std::optional<Hit> solid_hit(const Imath::V3d& origin,
                                               const Imath::V3d& direction) const;
    [[nodiscard]] Surface surface_at(const Hit& hit, const Imath::V3d& direction) const;

    struct Releases {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene tree) const { rtcReleaseScene(tree); }
    };
    const scene::Scene& scene_;
    std::unique_ptr<RTCDeviceTy, Releases> device_;
    std::unique_ptr<RTCSceneTy, Releases> tree_;
};

}  // namespace relume::reference
