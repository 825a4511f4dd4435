// Embree behind three questions: what does a ray hit, what is in its way, and which of sixteen
// rays see the sky.
#pragma once

#include "precompute/scene/scene.h"
#include "precompute/scene/surface_point.h"

#include <Imath/ImathVec.h>
#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace relume::bake {

struct Hit {
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    Imath::V2f barycentric{0, 0};
    float distance = 0;  // in lengths of the ray's direction
};

inline constexpr std::size_t kPacketSize = 16;

// Sixteen rays, their origins set up once, cast again and again with other directions.
class RayPacket {
  public:
    // All from one point.
    explicit RayPacket(const Imath::V3f& origin);
    // From points close to each other.
    explicit RayPacket(const std::array<Imath::V3f, kPacketSize>& origins);

    // Directions of any length; write those that are wanted before each cast.
    [[nodiscard]] float* x() { return rays_.dir_x; }
    [[nodiscard]] float* y() { return rays_.dir_y; }
    [[nodiscard]] float* z() { return rays_.dir_z; }

  private:
    friend class RayCaster;

    RTCRay16 rays_;
    alignas(64) std::array<int, kPacketSize> valid_{};
    RTCIntersectContext context_;
};

// A point just off the surface on the viewer's side, so that a ray from it does not meet the
// surface it left: by a few units in the last place of the coordinates that it was computed
// from, so that it is right for any size of scene and of triangle.
[[nodiscard]] Imath::V3f offset_origin(const scene::SurfacePoint& point);

// Holes of alpha-masked materials let rays through. Immutable and thread-safe; keeps a
// reference to the scene.
class RayCaster {
  public:
    // Builds the acceleration structure with the threads of the calling arena. Throws
    // BakeError when memory runs out.
    explicit RayCaster(const scene::Scene& scene);

    [[nodiscard]] const scene::Scene& scene() const { return *scene_; }

    [[nodiscard]] std::optional<Hit> closest_hit(const Imath::V3f& origin,
                                                 const Imath::V3f& direction) const;
    [[nodiscard]] bool is_occluded(const Imath::V3f& origin, const Imath::V3f& direction) const;
    // Bit i is set when bit i of `wanted` is set and nothing lies in the way of ray i. Fastest
    // when the directions are close to each other.
    [[nodiscard]] std::uint32_t unoccluded(RayPacket& packet, std::uint32_t wanted) const;

  private:
    struct MeshContext {
        const scene::Scene* scene;
        std::uint32_t mesh;
    };
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };

    void attach(const scene::Mesh& mesh, std::uint32_t index);
    static void pass_holes(const RTCFilterFunctionNArguments* arguments);

    const scene::Scene* scene_;
    std::vector<MeshContext> contexts_;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> accelerator_;
};

}  // namespace relume::bake
