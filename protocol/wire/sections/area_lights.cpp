#include "protocol/wire/sections/area_lights.h"

#include <algorithm>

namespace relume::wire {

bool any_solo(const AreaLights& lights) {
    return std::any_of(lights.begin(), lights.end(),
                       [](const auto& entry) { return entry.second.solo; });
}

bool lights_now(const AreaLight& light, bool any_solo) {
    return !light.muted && (light.solo || !any_solo);
}

AreaLight fresh_light(const AreaLights& others) {
    AreaLight light;
    const auto last = std::max_element(
        others.begin(), others.end(),
        [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    if (last != others.end()) {
        light.order = std::min(last->second.order + 1, kLightOrder.highest);
    }
    return light;
}

}  // namespace relume::wire
