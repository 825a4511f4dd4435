#include "protocol/wire/room_patch.h"

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/light_patch.h"
#include "protocol/wire/patch_section.h"
#include "protocol/wire/room_names.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr Range kAmount{0, 1};
constexpr Range kAngleDegrees{-1e6, 1e6};
constexpr Range kMilliseconds{0.1, 1000};
constexpr Range kTargetError{0, 1};
constexpr std::uint64_t kMaxCoefficients = 393216;  // 6·256²

json patch_environment(Environment& environment, const json& patch, const std::string& path) {
    PatchSection section(patch, path);
    section.take_name("name", environment.name);
    section.take_number("gain", kGain, environment.gain);
    section.take_vector("tint", kColour, environment.tint);
    return section.finish();
}

json patch_blend(Blend& blend, const json& patch, const std::string& path) {
    PatchSection section(patch, path);
    section.take_name("name", blend.name);
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

json patch_background(Background& background, const json& patch, const std::string& path) {
    PatchSection section(patch, path);
    section.take_word("mode", kBackgroundModeNames, background.mode);
    section.take_vector("colour", kColour, background.colour);
    return section.finish();
}

json patch_strategy(relighting::Strategy& strategy,
                    const json& patch,
                    const std::string& path) {
    PatchSection section(patch, path);
    section.take_word("method", relighting::kMethodNames, strategy.method);
    section.take_word("priority", relighting::kPriorityNames, strategy.priority);
    return section.finish();
}

json patch_budget(relighting::Budget& budget, const json& patch, const std::string& path) {
    PatchSection section(patch, path);
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
    PatchSection section(patch, path);
    section.take_number("exposure_stops", kExposureStops, display.exposure_stops);
    section.take_word("tone", kToneNames, display.tone);
    return section.finish();
}

}  // namespace

json apply_patch(RoomState& state, const json& patch, const Limits& limits) {
    RoomState next = state;
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
