// Environments by the name that the lab's options take.
#pragma once

#include "protocol/light/prefiltered_environment.h"

#include <cstdint>
#include <memory>
#include <string>

namespace relume::lab {

// A file (as light::import_environment), one of blender-data's CC0 maps ("studio", "night"), a
// procedural environment of protocol/light ("sky-afternoon"), or "bare-sun": a sun of half a
// degree radius and irradiance π over a sky of 0.01. Throws light::EnvironmentError.
[[nodiscard]] std::shared_ptr<const light::PrefilteredEnvironment> load_environment(
    const std::string& name_or_file,
    std::uint32_t face_resolution,
    float sharpening = light::PrefilteredEnvironment::kSharpening);

}  // namespace relume::lab
