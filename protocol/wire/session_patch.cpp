#include "protocol/wire/session_patch.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/names.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/session_names.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(),
                           std::numeric_limits<double>::max()};
constexpr Range kGain{0, 1e6};
constexpr Range kColour{0, 1e4};
constexpr Range kRadiance{0, 1e8};
constexpr Range kAmount{0, 1};
constexpr Range kAngleDegrees{-1e6, 1e6};
constexpr Range kAngularRadiusDegrees{0.05, 90};
constexpr Range kMilliseconds{0.1, 1000};
constexpr Range kTargetError{0, 1};
constexpr Range kExposureStops{-20, 20};
constexpr std::uint64_t kMaxCoefficients = 393216;  // 6·256²

// Divides by the length unless it is one already to rounding, so that normalising twice gives
// the same bits as normalising once. Scales first: the squares of 1e300 have no double.
void normalise(std::vector<double>& numbers, const std::string& path, const json& value) {
    const double largest =
        std::abs(*std::max_element(numbers.begin(), numbers.end(), [](double a, double b) {
            return std::abs(a) < std::abs(b);
        }));
    if (largest == 0) {
        throw WireError(ErrorCode::out_of_range, path, quote(value) + ", all of them zero",
                        "numbers that are not all zero");
    }
    const auto length_of = [&] {
        double squares = 0;
        for (const double x : numbers) {
            squares += x * x;
        }
        return std::sqrt(squares);
    };
    constexpr double kUnitTolerance = 1e-14;
    if (largest <= 1 && std::abs(length_of() - 1) <= kUnitTolerance) {
        return;
    }
    for (double& x : numbers) {
        x /= largest;
    }
    const double length = length_of();
    for (double& x : numbers) {
        x /= length;
    }
}

// One object of the patch: reads fields into the state and records them as normalised.
class Section {
  public:
    Section(const json& patch, std::string path) : reader_(patch, std::move(path)) {}

    void take_number(const char* key, Range range, double& target) {
        if (const json* value = reader_.find(key)) {
            target = number_from_json(*value, reader_.path_to(key), range);
            normalised_[key] = target;
        }
    }
    void take_vector(const char* key, Range range, Imath::V3d& target) {
        if (const json* value = reader_.find(key)) {
            target = vector_from_json(*value, reader_.path_to(key), range);
            normalised_[key] = *value;
        }
    }
    void take_direction(const char* key, Imath::V3d& target) {
        if (const json* value = reader_.find(key)) {
            const std::string path = reader_.path_to(key);
            std::vector<double> numbers = numbers_from_json(*value, path, 3, kAnyNumber);
            normalise(numbers, path, *value);
            target = {numbers[0], numbers[1], numbers[2]};
            normalised_[key] = std::move(numbers);
        }
    }
    void take_name(const char* key, std::string& target) {
        if (const json* value = reader_.find(key)) {
            target = name_from_json(*value, reader_.path_to(key));
            normalised_[key] = target;
        }
    }
    template <typename Enum, std::size_t Count>
    void take_word(const char* key, const NameTable<Enum, Count>& names, Enum& target) {
        if (const json* value = reader_.find(key)) {
            const std::string path = reader_.path_to(key);
            const auto word = names.value(string_from_json(*value, path));
            if (!word) {
                throw WireError(ErrorCode::out_of_range, path, quote(*value),
                                names.alternatives());
            }
            target = *word;
            normalised_[key] = *value;
        }
    }

    [[nodiscard]] ObjectReader& reader() { return reader_; }
    void record(const char* key, json value) { normalised_[key] = std::move(value); }
    // All fields have been asked for; the rest is unknown.
    [[nodiscard]] json finish() {
        reader_.refuse_other_keys();
        return std::move(normalised_);
    }

  private:
    ObjectReader reader_;
    json normalised_ = json::object();
};

json patch_environment(Environment& environment, const json& patch, const std::string& path) {
    Section section(patch, path);
    section.take_name("name", environment.name);
    section.take_number("gain", kGain, environment.gain);
    section.take_vector("tint", kColour, environment.tint);
    return section.finish();
}

json patch_blend(Blend& blend, const json& patch, const std::string& path) {
    Section section(patch, path);
    if (const json* name = section.reader().find("name")) {
        blend.name =
            name->is_null()
                ? std::nullopt
                : std::optional(name_from_json(*name, section.reader().path_to("name")));
        section.record("name", *name);
    }
    section.take_number("amount", kAmount, blend.amount);
    return section.finish();
}

json patch_rotation(Imath::Quatd& rotation, const json& patch, const std::string& path) {
    ObjectReader reader(patch, path);
    json normalised = json::object();
    const json* quaternion = reader.find("quaternion");
    double angles_degrees[3] = {0, 0, 0};
    bool has_angle = false;
    for (const auto& [key, angle_degrees] : {std::pair{"yaw_degrees", &angles_degrees[0]},
                                             std::pair{"pitch_degrees", &angles_degrees[1]},
                                             std::pair{"roll_degrees", &angles_degrees[2]}}) {
        if (const json* value = reader.find(key)) {
            *angle_degrees = number_from_json(*value, reader.path_to(key), kAngleDegrees);
            has_angle = true;
        }
    }
    reader.refuse_other_keys();
    if (quaternion != nullptr && has_angle) {
        throw WireError(ErrorCode::unsupported, path, "a quaternion and angles",
                        "one or the other");
    }
    if (quaternion != nullptr) {
        const std::string quaternion_path = reader.path_to("quaternion");
        std::vector<double> numbers =
            numbers_from_json(*quaternion, quaternion_path, 4, kAnyNumber);
        normalise(numbers, quaternion_path, *quaternion);
        rotation = Imath::Quatd(numbers[0], numbers[1], numbers[2], numbers[3]);
    } else if (has_angle) {
        rotation = quaternion_from_yaw_pitch_roll_degrees(angles_degrees[0], angles_degrees[1],
                                                          angles_degrees[2]);
    } else {
        return normalised;
    }
    normalised["quaternion"] = {rotation.r, rotation.v.x, rotation.v.y, rotation.v.z};
    return normalised;
}

json patch_light(std::map<std::string, AreaLight>& lights,
                 const std::string& id,
                 const json& patch,
                 const std::string& path) {
    const auto known = lights.find(id);
    AreaLight light = known == lights.end() ? AreaLight{} : known->second;
    Section section(patch, path);
    if (known == lights.end()) {
        for (const char* key : {"direction", "angular_radius_degrees", "radiance"}) {
            static_cast<void>(section.reader().require(key));
        }
    }
    section.take_direction("direction", light.direction);
    section.take_number("angular_radius_degrees", kAngularRadiusDegrees,
                        light.angular_radius_degrees);
    section.take_vector("radiance", kRadiance, light.radiance);
    section.take_number("gain", kGain, light.gain);
    section.take_vector("tint", kColour, light.tint);
    json normalised = section.finish();
    if (known == lights.end()) {
        normalised = to_json(light);
    }
    lights.insert_or_assign(id, light);
    return normalised;
}

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
        if (!is_name(id)) {
            throw WireError(ErrorCode::out_of_range, light_path, quote(json(id)),
                            "an id: " + std::string(kNameRule));
        }
        if (light.is_null()) {
            lights.erase(id);
            normalised[id] = nullptr;
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

json patch_background(Background& background, const json& patch, const std::string& path) {
    Section section(patch, path);
    section.take_word("mode", kBackgroundModeNames, background.mode);
    section.take_vector("colour", kColour, background.colour);
    return section.finish();
}

json patch_strategy(Strategy& strategy, const json& patch, const std::string& path) {
    Section section(patch, path);
    section.take_word("method", kMethodNames, strategy.method);
    section.take_word("priority", kPriorityNames, strategy.priority);
    return section.finish();
}

json patch_budget(Budget& budget, const json& patch, const std::string& path) {
    Section section(patch, path);
    const json* milliseconds = section.reader().find("milliseconds");
    const json* coefficients = section.reader().find("coefficients");
    const bool sets_milliseconds = milliseconds != nullptr && !milliseconds->is_null();
    const bool sets_coefficients = coefficients != nullptr && !coefficients->is_null();
    if (sets_milliseconds && sets_coefficients) {
        throw WireError(ErrorCode::unsupported, path, "milliseconds and coefficients",
                        "one or the other");
    }
    if (sets_milliseconds) {
        budget.milliseconds = number_from_json(
            *milliseconds, section.reader().path_to("milliseconds"), kMilliseconds);
        budget.coefficients.reset();
    }
    if (sets_coefficients) {
        budget.coefficients = static_cast<std::uint32_t>(integer_from_json(
            *coefficients, section.reader().path_to("coefficients"), 1, kMaxCoefficients));
        budget.milliseconds.reset();
    }
    // Null is what clears the other budget in a normalised patch; alone it would leave none.
    if ((milliseconds != nullptr && !sets_milliseconds && budget.milliseconds) ||
        (coefficients != nullptr && !sets_coefficients && budget.coefficients)) {
        throw WireError(ErrorCode::missing_field, path, "null for the only budget",
                        "milliseconds or coefficients");
    }
    if (sets_milliseconds || sets_coefficients) {
        section.record("milliseconds",
                       budget.milliseconds ? json(*budget.milliseconds) : json());
        section.record("coefficients",
                       budget.coefficients ? json(*budget.coefficients) : json());
    }
    section.take_number("target_error", kTargetError, budget.target_error);
    return section.finish();
}

json patch_display(Display& display, const json& patch, const std::string& path) {
    Section section(patch, path);
    section.take_number("exposure_stops", kExposureStops, display.exposure_stops);
    section.take_word("tone", kToneNames, display.tone);
    return section.finish();
}

}  // namespace

json apply_patch(SessionState& state, const json& patch, const Limits& limits) {
    SessionState next = state;
    ObjectReader reader(patch, "");
    json normalised = json::object();
    const auto take = [&](const char* key, auto apply) {
        if (const json* section = reader.find(key)) {
            if (json changed = apply(*section, reader.path_to(key)); !changed.empty()) {
                normalised[key] = std::move(changed);
            }
        }
    };
    using Path = const std::string&;
    take("environment",
         [&](const json& s, Path p) { return patch_environment(next.environment, s, p); });
    take("blend", [&](const json& s, Path p) { return patch_blend(next.blend, s, p); });
    take("rotation",
         [&](const json& s, Path p) { return patch_rotation(next.rotation, s, p); });
    take("lights",
         [&](const json& s, Path p) { return patch_lights(next.lights, s, p, limits); });
    take("background",
         [&](const json& s, Path p) { return patch_background(next.background, s, p); });
    take("strategy",
         [&](const json& s, Path p) { return patch_strategy(next.strategy, s, p); });
    take("budget", [&](const json& s, Path p) { return patch_budget(next.budget, s, p); });
    take("display", [&](const json& s, Path p) { return patch_display(next.display, s, p); });
    reader.refuse_other_keys();
    state = std::move(next);
    return normalised;
}

json merge_patches(json first, const json& second) {
    if (!first.is_object() || !second.is_object()) {
        return second;
    }
    for (const auto& [key, value] : second.items()) {
        const auto known = first.find(key);
        if (known == first.end()) {
            first[key] = value;
        } else {
            // Nulls stay: they remove what the state below still has.
            *known = merge_patches(std::move(*known), value);
        }
    }
    return first;
}

}  // namespace relume::wire
