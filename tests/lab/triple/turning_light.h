// A map that turns about the vertical from image to image.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace relume::lab {

// Of light and camera, an image.
inline constexpr double kTurnDegrees = 1.5;

class TurningLight {
  public:
    // Throws as load_environment does.
    TurningLight(const std::string& environment, std::uint32_t face_resolution);

    // Texels as of the image; valid until the next call.
    [[nodiscard]] std::array<std::span<const float>, 3> turned(std::uint32_t image);

  private:
    std::uint32_t n_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
};

}  // namespace relume::lab
