// Round lights at infinity.
#pragma once

#include "protocol/wire/sections/section.h"

namespace relume::wire {

// Its radiance is radiance · gain · tint over the whole disc where it lights (see
// `lights_now`), else zero.
struct AreaLight {
    Imath::V3d direction{0, 1, 0};  // unit, towards the light, in the world
    double angular_radius_degrees = 1;
    Imath::V3d radiance{0, 0, 0};
    double gain = 1;
    Imath::V3d tint{1, 1, 1};
    std::optional<std::string> name =
        std::nullopt;  // what people call it; a label as names.h allows
    bool muted = false;
    bool solo = false;
    double order = 0;  // lists show lights in ascending order, equals by id

    friend bool operator==(const AreaLight&, const AreaLight&) = default;
};

using AreaLights = std::map<std::string, AreaLight>;

// While any light is solo, muted or not, only solo lights light; environment and blend are
// dark.
[[nodiscard]] bool any_solo(const AreaLights& lights);
// A light that is muted never lights.
[[nodiscard]] bool lights_now(const AreaLight& light, bool any_solo);
// What a new light has where its patch does not say: defaults, and an order after all others.
[[nodiscard]] AreaLight fresh_light(const AreaLights& others);

inline constexpr Range kLightOrder{-1e9, 1e9};

inline constexpr std::array kAreaLightFields{
    field::direction<&AreaLight::direction>("direction", "towards the light, in the world")
        .needed(),
    field::number<&AreaLight::angular_radius_degrees>(
        "angular_radius_degrees", {0.05, 90}, "half the angle that the disc spans")
        .needed(),
    field::triple<&AreaLight::radiance>(
        "radiance", {0, 1e8}, "of the whole disc, linear Rec. 709")
        .needed(),
    field::number<&AreaLight::gain>("gain", kGain, "times the radiance"),
    field::triple<&AreaLight::tint>("tint", kColour, "times the radiance, by colour"),
    field::label<&AreaLight::name>(
        "name", "what people call the light; without one it is called by its ID"),
    field::flag<&AreaLight::muted>("muted", "it does not light"),
    field::flag<&AreaLight::solo>("solo", "while any light is solo, only solo lights light"),
    field::number<&AreaLight::order>(
        "order",
        kLightOrder,
        "lists show lights in ascending order; a new light without one comes last"),
};

inline constexpr KeyedSection<AreaLight> kAreaLights{
    {"lights", Stage::signal, "Round lights at infinity, by ID", kAreaLightFields},
    "area light",
    "lights",
    fresh_light,
    &Limits::lights_per_room};

}  // namespace relume::wire
