#include "server/net/rooms/light_signal.h"

#include <Imath/ImathMath.h>

#include <cstdint>
#include <numbers>
#include <utility>

namespace relume::net {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

light::AreaLight area_light_from(const wire::AreaLight& light) {
    return {.direction = Imath::V3f(light.direction),
            .angular_radius_radians =
                static_cast<float>(light.angular_radius_degrees * kRadiansPerDegree),
            .radiance = Imath::V3f(light.radiance * light.tint * light.gain)};
}

// Black, and a problem to report, if it cannot be decoded.
std::shared_ptr<const light::PrefilteredEnvironment> prefiltered(
    const std::shared_ptr<Environment>& environment,
    std::uint32_t face_resolution,
    const char* path,
    std::vector<wire::ErrorMessage>& problems) {
    if (!environment) {
        return nullptr;
    }
    try {
        return environment->prefiltered(face_resolution);
    } catch (const light::EnvironmentError& failure) {
        problems.push_back({.code = wire::ErrorCode::bad_image,
                            .message = "the environment cannot be decoded and is shown black",
                            .path = path,
                            .found = failure.found().empty() ? environment->description().name
                                                             : failure.found(),
                            .expected = failure.expected().empty() ? "a readable HDR image"
                                                                   : failure.expected(),
                            .edit_id = {}});
        return nullptr;
    }
}

light::LightRig rig_from_state(const wire::RoomState& state,
                               const NamedEnvironments& environments,
                               std::uint32_t face_resolution,
                               std::vector<wire::ErrorMessage>& problems) {
    light::LightRig rig;
    rig.environment =
        prefiltered(environments.environment, face_resolution, "/environment/name", problems);
    rig.blend = prefiltered(environments.blend, face_resolution, "/blend/name", problems);
    rig.blend_amount = environments.blend ? static_cast<float>(state.blend.amount) : 0.0F;
    rig.rotation = Imath::Quatf(state.rotation.quaternion);
    rig.environment_scale = Imath::V3f(state.environment.tint * state.environment.gain);
    const bool solo = wire::any_solo(state.lights);
    if (solo) {
        rig.environment = nullptr;
        rig.blend = nullptr;
    }
    for (const auto& [id, light] : state.lights) {
        if (wire::lights_now(light, solo)) {
            rig.lights.push_back(area_light_from(light));
        }
    }
    return rig;
}

}  // namespace

bool LightSignal::set_state(const wire::RoomState& state,
                            const NamedEnvironments& environments,
                            std::vector<wire::ErrorMessage>& problems) {
    const std::uint32_t n = projection_.basis().face_resolution();
    light::LightRig rig = rig_from_state(state, environments, n, problems);
    if (!coefficients_.empty() && rig == rig_) {
        return false;
    }
    rig_ = std::move(rig);
    environments_ = environments;
    other_cubemap_ = {};
    light::evaluate(rig_, n, cubemap_);
    light::lighting_coefficients(cubemap_, projection_, coefficients_);
    return true;
}

// Environments that the rig has could be decoded, and can be still.
const light::LightCubemap* LightSignal::cubemap(std::uint32_t face_resolution) {
    if (face_resolution == cubemap_.face_resolution) {
        return &cubemap_;
    }
    if (other_cubemap_.face_resolution != face_resolution) {
        light::LightRig rig = rig_;
        if (rig.environment) {
            rig.environment = environments_.environment->prefiltered(face_resolution);
        }
        if (rig.blend) {
            rig.blend = environments_.blend->prefiltered(face_resolution);
        }
        light::evaluate(rig, face_resolution, other_cubemap_);
    }
    return &other_cubemap_;
}

}  // namespace relume::net
