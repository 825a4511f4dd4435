// A white plane under the open sky, of which the image under a distant light is known.
#pragma once

#include "protocol/light/area_light.h"
#include "tests/stability/relit_image.h"
#include "tests/stability/workbench.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>

namespace relume::stability {

// The plane's normal is +Y and its albedo 1: every pixel shows E·cosθ/π, E being radiance ×
// solid angle of the light.
class OpenPlane {
  public:
    explicit OpenPlane(Workbench& workbench);

    [[nodiscard]] std::uint32_t face_resolution() const;
    // Mean over pixels and colours of the exact image.
    [[nodiscard]] double brightness(const light::LightCubemap& cubemap);
    [[nodiscard]] static double expected_brightness(const light::AreaLight& light);

    // How far, relatively, a lighting made of texels can be from it: the light is spread over
    // texels that it touches, and no point of a texel is farther than √2/n radians from its
    // middle, by which cosθ changes by tanθ·√2/n. To it comes what the transport lost when it
    // was stored, 1 % (its `measured` errors say less).
    [[nodiscard]] double tolerance(const Imath::V3f& direction) const;

    [[nodiscard]] const std::shared_ptr<const served::Scene>& scene() const { return scene_; }

  private:
    std::shared_ptr<const served::Scene> scene_;
    engine::Session session_;
};

}  // namespace relume::stability
