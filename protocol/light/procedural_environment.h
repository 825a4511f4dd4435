// Environments made by formula, for machines without any file.
#pragma once

#include "protocol/light/environment_map.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace relume::light {

// Clear daylight [Preetham99] with the sun's disc, or the overcast sky of the CIE, over a
// diffuse ground. One unit of radiance is 10 kcd/m².
struct SkyParameters {
    float sun_elevation_radians = 0.7F;  // in [0, π/2]
    float sun_azimuth_radians = 0.5F;    // from −Z towards +X
    float turbidity = 3.0F;              // in [1.7, 10]: 2 very clear, 6 hazy
    bool overcast = false;               // no sun, no colour
    Imath::V3f ground_albedo{0.25F, 0.23F, 0.20F};
    std::uint32_t height = 1024;  // of a lat-long map; in [16, 4096]
};
[[nodiscard]] EnvironmentMap procedural_sky(const SkyParameters& parameters);

// A dark studio with a rectangular key, a fill, a strip behind and a ceiling panel.
[[nodiscard]] EnvironmentMap softbox_studio(std::uint32_t height = 1024);

// The environments offered by name: "sky-noon", "sky-afternoon", "sky-sunset", "sky-overcast",
// "studio-softboxes".
[[nodiscard]] const std::vector<std::string_view>& procedural_environment_names();
// Throws EnvironmentError on an unknown name.
[[nodiscard]] EnvironmentMap procedural_environment(std::string_view name);

}  // namespace relume::light
