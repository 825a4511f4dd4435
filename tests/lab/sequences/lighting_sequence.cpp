#include "tests/lab/sequences/lighting_sequence.h"

#include "protocol/wire/room_state.h"
#include "tests/lab/geometry/orbit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Takes the members of one object; what nobody took is refused.
class ObjectReader {
  public:
    ObjectReader(const nlohmann::json& json, std::string where)
        : json_(&json), where_(std::move(where)) {
        if (!json.is_object()) {
            refuse("", json, "an object");
        }
    }

    template <typename T>
    T take(const char* key, std::string_view expected) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) {
            refuse("", *json_, fmt::format("\"{}\", {}", key, expected));
        }
        try {
            return value->get<T>();
        } catch (const nlohmann::json::exception&) {
            refuse(key, *value, expected);
        }
    }
    // Leaves `curve` as it is where there is none.
    void take_curve(const char* key, std::uint64_t stream, Curve& curve) {
        if (const nlohmann::json* value = find(key)) {
            curve = curve_from_json(*value, where_ + "/" + key, stream);
        }
    }
    // Null: there is none.
    const nlohmann::json* find(const char* key) {
        taken_.emplace_back(key);
        const auto found = json_->find(key);
        return found == json_->end() ? nullptr : &*found;
    }
    void expect_no_more() const {
        for (const auto& [key, value] : json_->items()) {
            if (std::find(taken_.begin(), taken_.end(), key) == taken_.end()) {
                refuse(key.c_str(), value, fmt::format("one of {}", fmt::join(taken_, ", ")));
            }
        }
    }

  private:
    [[noreturn]] void refuse(const char* key,
                             const nlohmann::json& found,
                             std::string_view expected) const {
        throw std::invalid_argument(
            fmt::format("{}/{}: found {}, expected {}", where_, key, found.dump(), expected));
    }

    const nlohmann::json* json_;
    std::string where_;
    std::vector<std::string> taken_;
};

LightCurves light_from_json(const nlohmann::json& json, std::size_t number) {
    const std::uint64_t stream = 16 * (number + 1);
    ObjectReader reader(json, fmt::format("/lights/{}", number));
    LightCurves light;
    reader.take_curve("azimuth_degrees", stream, light.azimuth_degrees);
    reader.take_curve("elevation_degrees", stream + 1, light.elevation_degrees);
    reader.take_curve("radius_degrees", stream + 2, light.radius_degrees);
    reader.take_curve("radiance", stream + 3, light.radiance);
    reader.expect_no_more();
    return light;
}

Imath::Quatf rotation_of_image(const LightingSequence& sequence, std::uint32_t image) {
    const Imath::Quatd rotation = wire::quaternion_from_yaw_pitch_roll_degrees(
        sequence.yaw_degrees.at(image, sequence.seed),
        sequence.pitch_degrees.at(image, sequence.seed),
        sequence.roll_degrees.at(image, sequence.seed));
    return Imath::Quatf(rotation);
}

light::AreaLight light_of_image(const LightCurves& curves,
                                std::uint64_t seed,
                                std::uint32_t image) {
    const double azimuth = kRadiansPerDegree * curves.azimuth_degrees.at(image, seed);
    const double elevation = kRadiansPerDegree * curves.elevation_degrees.at(image, seed);
    return {.direction = {static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                          static_cast<float>(std::sin(elevation)),
                          static_cast<float>(-std::cos(elevation) * std::cos(azimuth))},
            .angular_radius_radians =
                static_cast<float>(kRadiansPerDegree * curves.radius_degrees.at(image, seed)),
            .radiance = Imath::V3f(static_cast<float>(curves.radiance.at(image, seed)))};
}

nlohmann::json json_from_file(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) {
        throw std::invalid_argument(fmt::format("sequence '{}': expected a file or one of {}",
                                                file.string(),
                                                fmt::join(sequence_names(), ", ")));
    }
    try {
        return nlohmann::json::parse(stream);
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace

std::uint32_t LightingSequence::rests_from() const {
    std::uint32_t latest = 0;
    for (const Curve* curve :
         {&yaw_degrees, &pitch_degrees, &roll_degrees, &gain, &blend, &orbit_degrees}) {
        latest = std::max(latest, curve->rests_from());
    }
    for (const LightCurves& light : lights) {
        for (const Curve* curve : {&light.azimuth_degrees, &light.elevation_degrees,
                                   &light.radius_degrees, &light.radiance}) {
            latest = std::max(latest, curve->rests_from());
        }
    }
    return std::min(latest, images);
}

bool LightingSequence::moves_camera() const {
    for (std::uint32_t image = 0; image < images; ++image) {
        if (orbit_degrees.at(image, seed) != 0) {
            return true;
        }
    }
    return false;
}

light::LightRig rig_of_image(const LightingSequence& sequence,
                             const Environments& environments,
                             std::uint32_t image) {
    light::LightRig rig;
    rig.environment = environments.environment;
    rig.blend = environments.blend;
    rig.blend_amount = static_cast<float>(sequence.blend.at(image, sequence.seed));
    rig.rotation = rotation_of_image(sequence, image);
    rig.environment_scale =
        Imath::V3f(static_cast<float>(sequence.gain.at(image, sequence.seed)));
    for (const LightCurves& curves : sequence.lights) {
        const light::AreaLight light = light_of_image(curves, sequence.seed, image);
        if (light.radiance != Imath::V3f(0)) {
            rig.lights.push_back(light);
        }
    }
    return rig;
}

view::Look look_of_image(const LightingSequence& sequence,
                         const view::Look& beginning,
                         std::uint32_t image) {
    const double degrees = sequence.orbit_degrees.at(image, sequence.seed);
    return degrees == 0 ? beginning : orbited(beginning, degrees);
}

LightingSequence sequence_from_json(const nlohmann::json& json) {
    ObjectReader reader(json, "");
    LightingSequence sequence;
    sequence.name = reader.take<std::string>("name", "a name");
    sequence.description = reader.take<std::string>("description", "a sentence");
    sequence.images = reader.take<std::uint32_t>("images", "a number of images");
    sequence.seed = reader.take<std::uint64_t>("seed", "a number");
    reader.take_curve("yaw_degrees", 0, sequence.yaw_degrees);
    reader.take_curve("pitch_degrees", 1, sequence.pitch_degrees);
    reader.take_curve("roll_degrees", 2, sequence.roll_degrees);
    reader.take_curve("gain", 3, sequence.gain);
    reader.take_curve("blend", 4, sequence.blend);
    reader.take_curve("orbit_degrees", 5, sequence.orbit_degrees);
    if (const nlohmann::json* lights = reader.find("lights")) {
        for (std::size_t i = 0; i < lights->size(); ++i) {
            sequence.lights.push_back(light_from_json(lights->at(i), i));
        }
    }
    reader.expect_no_more();
    return sequence;
}

std::vector<std::string> sequence_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(RELUME_LAB_SEQUENCES)) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

LightingSequence load_sequence(const std::string& name_or_file) {
    const fs::path built_in = fs::path(RELUME_LAB_SEQUENCES) / (name_or_file + ".json");
    const fs::path file = fs::exists(built_in) ? built_in : fs::path(name_or_file);
    try {
        return sequence_from_json(json_from_file(file));
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}", file.string(), error.what()));
    }
}

}  // namespace relume::lab
