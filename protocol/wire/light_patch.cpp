#include "protocol/wire/light_patch.h"

#include "protocol/base/text/names.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/patch_section.h"

#include <algorithm>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr Range kRadiance{0, 1e8};
constexpr Range kAngularRadiusDegrees{0.05, 90};
constexpr Range kOrder{-1e9, 1e9};

// After all others.
double order_of_new_light(const std::map<std::string, AreaLight>& lights) {
    const auto last = std::max_element(
        lights.begin(), lights.end(),
        [](const auto& a, const auto& b) { return a.second.order < b.second.order; });
    return last == lights.end() ? 0 : std::min(last->second.order + 1, kOrder.highest);
}

json patch_light(std::map<std::string, AreaLight>& lights,
                 const std::string& id,
                 const json& patch,
                 const std::string& path) {
    const auto known = lights.find(id);
    const bool is_new = known == lights.end();
    AreaLight light = is_new ? AreaLight{} : known->second;
    PatchSection section(patch, path);
    if (is_new) {
        for (const char* key : {"direction", "angular_radius_degrees", "radiance"}) {
            static_cast<void>(section.reader().require(key));
        }
        light.order = order_of_new_light(lights);
    }
    section.take_direction("direction", light.direction);
    section.take_number("angular_radius_degrees", kAngularRadiusDegrees,
                        light.angular_radius_degrees);
    section.take_vector("radiance", kRadiance, light.radiance);
    section.take_number("gain", kGain, light.gain);
    section.take_vector("tint", kColour, light.tint);
    section.take_label("name", light.name);
    section.take_flag("muted", light.muted);
    section.take_flag("solo", light.solo);
    section.take_number("order", kOrder, light.order);
    json normalised = section.finish();
    if (is_new) {
        normalised = to_json(light);
        if (!light.name) {
            // Merged over the removal of a light that had a name, this takes the name away.
            normalised["name"] = nullptr;
        }
    }
    lights.insert_or_assign(id, light);
    return normalised;
}

}  // namespace

json patch_lights(std::map<std::string, AreaLight>& lights,
                  const json& patch,
                  const std::string& path,
                  const Limits& limits) {
    if (!patch.is_object()) {
        throw WireError(ErrorCode::wrong_type, path, quote(patch), "an object of lights");
    }
    json normalised = json::object();
    for (const auto& [id, light] : patch.items()) {
        const std::string light_path = pointer_step(path, id);
        if (!text::is_name(id)) {
            throw WireError(ErrorCode::out_of_range, light_path, quote(json(id)),
                            "an id: " + std::string(text::kNameRule));
        }
        if (light.is_null()) {
            // What is not there cannot be removed, and clients need not hear of it.
            if (lights.erase(id) != 0) {
                normalised[id] = nullptr;
            }
        } else if (json changed = patch_light(lights, id, light, light_path);
                   !changed.empty()) {
            normalised[id] = std::move(changed);
        }
    }
    if (lights.size() > limits.lights_per_room) {
        throw WireError(ErrorCode::too_many, path, std::to_string(lights.size()) + " lights",
                        "at most " + std::to_string(limits.lights_per_room));
    }
    return normalised;
}

}  // namespace relume::wire
