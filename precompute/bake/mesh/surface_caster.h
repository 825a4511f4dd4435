// Rays to the surface of a mesh transport, as a camera casts them.
#pragma once

#include "protocol/transport/surface.h"

#include <Imath/ImathVec.h>
#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace relume::bake {

struct SurfaceHit {
    std::uint32_t triangle = 0;
    Imath::V2f barycentric{0, 0};  // weigh its second and third corner
};

// Only the side of a triangle from which its corners run counter-clockwise is met, and no hole
// of its material. Immutable and thread-safe.
class SurfaceCaster {
  public:
    // Copies the positions, and keeps references to both. Throws BakeError when memory runs
    // out.
    SurfaceCaster(const transport::Surface& surface,
                  const std::vector<transport::MaterialRecord>& materials);
    SurfaceCaster(const SurfaceCaster&) = delete;
    SurfaceCaster& operator=(const SurfaceCaster&) = delete;
    ~SurfaceCaster() = default;

    [[nodiscard]] std::optional<SurfaceHit> closest_hit(const Imath::V3f& origin,
                                                        const Imath::V3f& direction) const;

  private:
    // Backs, and holes.
    static void refuse_unseen(const RTCFilterFunctionNArguments* arguments);

    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };

    const transport::Surface& surface_;
    const std::vector<transport::MaterialRecord>& materials_;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> accelerator_;
};

}  // namespace relume::bake
