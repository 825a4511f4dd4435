#include "tests/lab/triple/turning_light.h"

#include "tests/lab/sequences/environment_source.h"

#include <numbers>
#include <utility>

namespace relume::lab {

TurningLight::TurningLight(const std::string& environment, std::uint32_t face_resolution)
    : n_(face_resolution) {
    rig_.environment = load_environment(environment, n_);
}

std::array<std::span<const float>, 3> TurningLight::turned(std::uint32_t image) {
    rig_.rotation.setAxisAngle(
        {0, 1, 0}, static_cast<float>(image * kTurnDegrees * std::numbers::pi / 180));
    light::evaluate(rig_, n_, cubemap_);
    const auto planes = std::as_const(cubemap_).planes();
    return {planes[0], planes[1], planes[2]};
}

}  // namespace relume::lab
