// The light that a bake of curves is frozen under: an environment, turned and scaled.
#pragma once

#include "protocol/light/background.h"
#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace relume::bake {

struct LightRequest {
    std::string environment{};  // file, or name of one made by formula
    std::string centre{};       // of the map, as light::map_centre_names(); empty: -z
    Imath::V3d rotation_degrees{0, 0, 0};  // yaw, pitch, roll
    double gain = 1;
};

struct FrozenLight {
    light::LightRig rig;
    light::LightCubemap cubemap;  // the rig, as servers relight with it (protocol/light.md)
    // For people: environment, checksum of its texels, rotation, gain, light resolution.
    nlohmann::json description = nlohmann::json::object();
};

// Throws program::UsageError for a name that is neither a file nor an environment made by
// formula, and for a gain that is no finite number from 0 to 1e6; light::EnvironmentError,
// files::FileError for what cannot be read.
[[nodiscard]] FrozenLight frozen_light(const LightRequest& request,
                                       std::uint32_t face_resolution);

}  // namespace relume::bake
