#include "client/cli/material_options.h"

#include "client/cli/client_error.h"
#include "client/cli/option_text.h"
#include "client/cli/server_names.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_names.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/curve/curve.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace relume::cli {
namespace {

using nlohmann::json;

std::pair<std::string, std::string> material_and_rest(const std::string& text,
                                                      std::string_view option,
                                                      std::string_view form) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        throw program::UsageError(
            fmt::format("{}: found \"{}\", expected {}", option, text, form));
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

bool is_sample(const json& value) {
    const auto is_number = [](const json& part) { return part.is_number(); };
    return value.is_number() || (value.is_array() && value.size() == 3 &&
                                 std::all_of(value.begin(), value.end(), is_number));
}

// Samples are a number each, or three.
json samples_from_json(const json& curve, const std::string& source) {
    if (curve.size() != curve::kCurveSamples) {
        throw ClientError(fmt::format("{}: found {} samples, expected {}", source, curve.size(),
                                      curve::kCurveSamples));
    }
    json samples = json::array();
    for (std::size_t k = 0; k < curve.size(); ++k) {
        if (!is_sample(curve[k])) {
            throw ClientError(
                fmt::format("{}: sample {}: found {}, expected a number or "
                            "three for red, green and blue",
                            source, k, text::quote(curve[k])));
        }
        samples.push_back(curve[k].is_array() ? curve[k] : json{curve[k], curve[k], curve[k]});
    }
    return samples;
}

void put_curve(json& materials, const std::string& text) {
    const auto [material, json_or_file] =
        material_and_rest(text, "--curve", "MATERIAL=JSON or MATERIAL=@FILE");
    const auto [curve, source] = json_from_option(json_or_file, "--curve " + material);
    json& entry = materials[material];
    if (curve.is_array()) {
        entry["samples"] = samples_from_json(curve, source);
    } else if (curve.is_object()) {
        entry.update(curve);
    } else {
        throw ClientError(fmt::format("{}: found {}, expected {} samples or an object", source,
                                      text::quote(curve), curve::kCurveSamples));
    }
}

void put_colour(json& materials,
                const std::string& text,
                const char* key,
                std::string_view option) {
    const auto [material, colour] = material_and_rest(text, option, "MATERIAL=R,G,B");
    materials[material][key] = numbers_from_option(colour, 3, option, "MATERIAL=R,G,B");
}

}  // namespace

json materials_from_options(const MaterialOptions& options) {
    json materials = json::object();
    for (const std::string& curve : options.curves) {
        put_curve(materials, curve);
    }
    for (const std::string& diffuse : options.diffuses) {
        put_colour(materials, diffuse, "diffuse", "--diffuse");
    }
    for (const std::string& tint : options.tints) {
        put_colour(materials, tint, "tint", "--tint");
    }
    return materials;
}

void require_materials(const Url& server, const std::string& scene, const json& materials) {
    if (materials.empty()) {
        return;
    }
    const std::vector<std::string> known = materials_of(server, scene);
    if (known.empty()) {
        throw ClientError(fmt::format(
            "scene {}: found no materials that can be edited, expected one of kind "
            "curves, or an image baked with --editable",
            text::quote(scene)));
    }
    for (const auto& [material, edit] : materials.items()) {
        if (std::find(known.begin(), known.end(), material) == known.end()) {
            throw ClientError(fmt::format(
                "material {}: the scene has none of that name, expected {}",
                text::quote(material), text::expected_name(material, known, "materials")));
        }
    }
}

}  // namespace relume::cli
