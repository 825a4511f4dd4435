#include "client/cli/edit_options.h"

#include "client/cli/client_error.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/wire/room_patch.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <string_view>

namespace relume::cli {
namespace {

using nlohmann::json;

// What a server takes in one message by default.
constexpr std::size_t kMaxPatchBytes = std::size_t{64} << 10;

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

std::vector<double> numbers_from_text(std::string_view text,
                                      std::size_t count,
                                      std::string_view option,
                                      std::string_view form) {
    std::vector<double> numbers;
    for (const std::string_view part : split(text, ',')) {
        double number = 0;
        const auto [end, error] =
            std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc{} || end != part.data() + part.size()) {
            numbers.clear();
            break;
        }
        numbers.push_back(number);
    }
    if (numbers.size() != count) {
        throw program::UsageError(
            fmt::format("{}: found \"{}\", expected {}", option, text, form));
    }
    return numbers;
}

void put_light(json& patch, std::string_view text) {
    constexpr std::string_view kForm = "ID:X,Y,Z:RADIUS_DEGREES:R,G,B";
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() != 4) {
        throw program::UsageError(
            fmt::format("--light: found \"{}\", expected {}", text, kForm));
    }
    patch["lights"][std::string(parts[0])] = {
        {"direction", numbers_from_text(parts[1], 3, "--light", kForm)},
        {"angular_radius_degrees", numbers_from_text(parts[2], 1, "--light", kForm)[0]},
        {"radiance", numbers_from_text(parts[3], 3, "--light", kForm)}};
}

void put_triple(json& section,
                const char* key,
                std::string_view text,
                std::string_view option) {
    if (!text.empty()) {
        section[key] = numbers_from_text(text, 3, option, "X,Y,Z");
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
    const std::vector<std::string_view> sides = split(text, 'x');
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
    std::string json_text = text_or_file;
    std::string source = "--patch";
    if (json_text.starts_with('@')) {
        source = json_text.substr(1);
        try {
            json_text = files::read_regular_file(source, kMaxPatchBytes);
        } catch (const files::FileError& error) {
            throw ClientError(error.what());
        }
    }
    try {
        json patch = text::parse_strict_json(json_text, kMaxPatchBytes);
        if (!patch.is_object()) {
            throw ClientError(fmt::format("{}: found {}, expected a JSON object", source,
                                          text::quote(patch)));
        }
        return patch;
    } catch (const text::JsonError& error) {
        throw ClientError(source + ": " + error.what());
    }
}

json patch_from_options(const EditOptions& options, const std::string& environment) {
    const json base = patch_from_text(options.patch);
    json patch = json::object();
    if (!environment.empty()) {
        patch["environment"]["name"] = environment;
    }
    if (!options.rotate.empty()) {
        const std::vector<double> degrees =
            numbers_from_text(options.rotate, 3, "--rotate", "YAW,PITCH,ROLL in degrees");
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
    return wire::merge_patches(base, patch);
}

}  // namespace relume::cli
