#include "client/cli/edit_options.h"

#include "client/cli/client_error.h"
#include "client/cli/finish_options.h"
#include "client/cli/option_text.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/split.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/wire/room_patch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <string_view>

namespace relume::cli {
namespace {

using nlohmann::json;

void put_light(json& patch, std::string_view text) {
    constexpr std::string_view kForm = "ID:X,Y,Z:RADIUS_DEGREES:R,G,B";
    const std::vector<std::string_view> parts = text::split(text, ':');
    if (parts.size() != 4) {
        throw program::UsageError(
            fmt::format("--light: found \"{}\", expected {}", text, kForm));
    }
    patch["lights"][std::string(parts[0])] = {
        {"direction", numbers_from_option(parts[1], 3, "--light", kForm)},
        {"angular_radius_degrees", numbers_from_option(parts[2], 1, "--light", kForm)[0]},
        {"radiance", numbers_from_option(parts[3], 3, "--light", kForm)}};
}

void put_triple(json& section,
                const char* key,
                std::string_view text,
                std::string_view option) {
    if (!text.empty()) {
        section[key] = numbers_from_option(text, 3, option, "X,Y,Z");
    }
}

void put_camera(json& patch, const EditOptions& options) {
    json camera = json::object();
    put_triple(camera, "eye", options.eye, "--eye");
    put_triple(camera, "look_at", options.look_at, "--look-at");
    put_triple(camera, "up", options.up, "--up");
    if (options.fov_degrees) {
        camera["fov_degrees"] = *options.fov_degrees;
    }
    if (!camera.empty()) {
        patch["camera"] = std::move(camera);
    }
}

void put_size(json& patch, std::string_view text) {
    constexpr std::string_view kForm = "WIDTHxHEIGHT";
    const std::vector<std::string_view> sides = text::split(text, 'x');
    std::vector<std::uint32_t> pixels;
    for (const std::string_view side : sides) {
        std::uint32_t number = 0;
        const auto [end, error] =
            std::from_chars(side.data(), side.data() + side.size(), number);
        if (error == std::errc{} && end == side.data() + side.size()) {
            pixels.push_back(number);
        }
    }
    if (sides.size() != 2 || pixels.size() != 2) {
        throw program::UsageError(
            fmt::format("--size: found \"{}\", expected {}", text, kForm));
    }
    patch["image"] = {{"width", pixels[0]}, {"height", pixels[1]}};
}

}  // namespace

json patch_from_text(const std::string& text_or_file) {
    if (text_or_file.empty()) {
        return json::object();
    }
    OptionJson patch = json_from_option(text_or_file, "--patch");
    if (!patch.value.is_object()) {
        throw ClientError(fmt::format("{}: found {}, expected a JSON object", patch.source,
                                      text::quote(patch.value)));
    }
    return std::move(patch.value);
}

json patch_from_options(const EditOptions& options, const std::string& environment) {
    const json base = patch_from_text(options.patch);
    json patch = json::object();
    if (!environment.empty()) {
        patch["environment"]["name"] = environment;
    }
    if (!options.rotate.empty()) {
        const std::vector<double> degrees =
            numbers_from_option(options.rotate, 3, "--rotate", "YAW,PITCH,ROLL in degrees");
        patch["rotation"] = {{"yaw_degrees", degrees[0]},
                             {"pitch_degrees", degrees[1]},
                             {"roll_degrees", degrees[2]}};
    }
    for (const std::string& light : options.lights) {
        put_light(patch, light);
    }
    put_camera(patch, options);
    if (!options.size.empty()) {
        put_size(patch, options.size);
    }
    if (!options.method.empty()) {
        patch["strategy"]["method"] = options.method;
    }
    if (!options.priority.empty()) {
        patch["strategy"]["priority"] = options.priority;
    }
    if (options.budget_ms) {
        patch["budget"]["milliseconds"] = *options.budget_ms;
    }
    if (options.coefficients) {
        patch["budget"]["coefficients"] = *options.coefficients;
    }
    if (json materials = materials_from_options(options.materials); !materials.empty()) {
        patch["materials"] = std::move(materials);
    }
    if (json finishes = finishes_from_options(options.finishes); !finishes.empty()) {
        patch["finishes"] = std::move(finishes);
    }
    return wire::merge_patches(base, patch);
}

}  // namespace relume::cli
