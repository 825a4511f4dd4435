#include "precompute/bake/curves/frozen_light.h"

#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_names.h"
#include "protocol/light/environment_import.h"
#include "protocol/light/procedural_environment.h"
#include "protocol/transport/checksum.h"
#include "protocol/wire/sections/rotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

constexpr double kMostGain = 1e6;

light::MapCentre centre_of(const LightRequest& request) {
    if (request.centre.empty()) {
        return light::MapCentre::negative_z;
    }
    if (const auto centre = light::map_centre_from_string(request.centre)) {
        return *centre;
    }
    throw program::UsageError(fmt::format("--centre is '{}', expected one of {}",
                                          request.centre, light::map_centre_names()));
}

light::EnvironmentMap environment_of(const LightRequest& request, nlohmann::json& description) {
    const auto& names = light::procedural_environment_names();
    if (std::find(names.begin(), names.end(), request.environment) != names.end()) {
        return light::procedural_environment(request.environment);
    }
    if (!std::filesystem::exists(request.environment)) {
        throw program::UsageError(fmt::format(
            "--environment {}: no such file, and no environment made by formula; expected a "
            "file or {}",
            request.environment,
            text::expected_name(request.environment,
                                std::vector<std::string>(names.begin(), names.end()),
                                "environments")));
    }
    light::ImportedEnvironment imported =
        light::import_environment(request.environment, {.centre = centre_of(request)});
    if (!imported.notes.warnings.empty()) {
        description["warnings"] = imported.notes.warnings;
    }
    return std::move(imported.map);
}

}  // namespace

FrozenLight frozen_light(const LightRequest& request, std::uint32_t face_resolution) {
    if (!(request.gain >= 0 && request.gain <= kMostGain)) {
        throw program::UsageError(
            fmt::format("--gain is {}, expected 0 to {:g}", request.gain, kMostGain));
    }
    FrozenLight frozen;
    const auto map = std::make_shared<const light::EnvironmentMap>(
        environment_of(request, frozen.description));
    const Imath::V3d& degrees = request.rotation_degrees;
    frozen.rig.environment =
        std::make_shared<const light::PrefilteredEnvironment>(map, face_resolution);
    frozen.rig.rotation = Imath::Quatf(
        wire::quaternion_from_yaw_pitch_roll_degrees(degrees.x, degrees.y, degrees.z));
    frozen.rig.environment_scale = Imath::V3f(static_cast<float>(request.gain));
    light::evaluate(frozen.rig, face_resolution, frozen.cubemap);
    frozen.description["environment"] =
        std::filesystem::path(request.environment).filename().string();
    frozen.description["map_checksum"] = transport::text_from_checksum(
        transport::checksum(std::as_bytes(std::span(map->levels().front().rgb))));
    frozen.description["yaw_degrees"] = degrees.x;
    frozen.description["pitch_degrees"] = degrees.y;
    frozen.description["roll_degrees"] = degrees.z;
    frozen.description["gain"] = request.gain;
    frozen.description["face_resolution"] = face_resolution;
    return frozen;
}

}  // namespace relume::bake
