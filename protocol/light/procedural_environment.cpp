#include "protocol/light/procedural_environment.h"

#include "protocol/light/environment_error.h"

#include <fmt/core.h>

namespace relume::light {

const std::vector<std::string_view>& procedural_environment_names() {
    static const std::vector<std::string_view> names{"sky-noon", "sky-afternoon", "sky-sunset",
                                                     "sky-overcast", "studio-softboxes"};
    return names;
}

EnvironmentMap procedural_environment(std::string_view name) {
    if (name == "sky-noon") {
        return procedural_sky({.sun_elevation_radians = 1.1F, .turbidity = 2.5F});
    }
    if (name == "sky-afternoon") {
        return procedural_sky({.sun_elevation_radians = 0.55F, .turbidity = 3.0F});
    }
    if (name == "sky-sunset") {
        return procedural_sky({.sun_elevation_radians = 0.07F, .turbidity = 4.0F});
    }
    if (name == "sky-overcast") {
        return procedural_sky({.sun_elevation_radians = 0.8F, .overcast = true});
    }
    if (name == "studio-softboxes") {
        return softbox_studio();
    }
    throw EnvironmentError(fmt::format("there is no procedural environment named {}", name),
                           std::string(name));
}

}  // namespace relume::light
