// The map that lights the scene.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

struct Environment {
    std::string name = "sky";
    double gain = 1;
    Imath::V3d tint{1, 1, 1};

    friend bool operator==(const Environment&, const Environment&) = default;
};

inline constexpr std::array kEnvironmentFields{
    field::name<&Environment::name>("name", "the map, by its name in `/api/environments`"),
    field::number<&Environment::gain>("gain", kGain, "times the map's radiance"),
    field::triple<&Environment::tint>("tint", kColour, "times the map's radiance, by colour"),
};

inline constexpr Section<Environment> kEnvironment{
    "environment", Stage::signal, "The map that lights the scene", kEnvironmentFields};

}  // namespace relume::wire
