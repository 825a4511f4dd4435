#include "precompute/materials/model_words.h"

#include "precompute/factors/merl_brdf.h"
#include "precompute/scene/bsdf.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_names.h"
#include "protocol/base/text/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relume::materials {
namespace {

struct Parameter {
    std::string name;
    bool is_colour = false;
    float lowest = 0;
    float highest = 1;
    Imath::V3f value{1, 1, 1};  // three times the same where it is no colour
};

std::optional<float> number_from(std::string_view text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

void set_value(Parameter& parameter, std::string_view text, std::string_view words) {
    const auto parts = text::split(text, '/');
    const bool has_right_count =
        parts.size() == 1 || (parameter.is_colour && parts.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number =
            has_right_count ? number_from(parts[std::min(i, parts.size() - 1)]) : std::nullopt;
        if (!number || !(*number >= parameter.lowest && *number <= parameter.highest)) {
            throw program::UsageError(fmt::format(
                "--model {}: {} is '{}', expected {} from {} to {}", words, parameter.name,
                text, parameter.is_colour ? "a number, or three as r/g/b," : "a number",
                parameter.lowest, parameter.highest));
        }
        parameter.value[static_cast<int>(i)] = *number;
    }
}

// What is said after the model's name, `rest`, goes into `parameters`.
void set_values(std::vector<Parameter>& parameters,
                std::optional<std::string_view> rest,
                std::string_view words) {
    if (!rest) {
        return;
    }
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters) {
        names.push_back(parameter.name);
    }
    for (const std::string_view assignment : text::split(*rest, ',')) {
        const std::size_t equals = std::min(assignment.find('='), assignment.size());
        const std::string name(assignment.substr(0, equals));
        const auto named = std::find(names.begin(), names.end(), name);
        if (named == names.end() || equals == assignment.size()) {
            throw program::UsageError(
                fmt::format("--model {}: found '{}', expected PARAMETER=VALUE, PARAMETER {}",
                            words, assignment, text::expected_name(name, names, "parameters")));
        }
        set_value(parameters[static_cast<std::size_t>(named - names.begin())],
                  assignment.substr(equals + 1), words);
    }
}

FieldModel lambert_from(std::optional<std::string_view> rest, std::string_view words) {
    std::vector<Parameter> parameters{{.name = "colour", .is_colour = true}};
    set_values(parameters, rest, words);
    FieldModel model = lambert_model();
    model.colours = {parameters[0].value};
    return model;
}

FieldModel phong_from(std::optional<std::string_view> rest, std::string_view words) {
    std::vector<Parameter> parameters{
        {.name = "exponent", .lowest = 1, .highest = 1e4F, .value = Imath::V3f(64)},
        {.name = "colour", .is_colour = true}};
    set_values(parameters, rest, words);
    FieldModel model = phong_model(parameters[0].value.x);
    model.colours = {parameters[1].value};
    return model;
}

FieldModel ggx_from(std::optional<std::string_view> rest, std::string_view words) {
    std::vector<Parameter> parameters{
        {.name = "roughness", .lowest = scene::Bsdf::kMinRoughness, .value = Imath::V3f(0.3F)},
        {.name = "base", .is_colour = true, .value = Imath::V3f(0.8F)},
        {.name = "metallic", .value = Imath::V3f(0)}};
    set_values(parameters, rest, words);
    return lobes_model(
        "ggx", factors::lobes_of(scene::Bsdf::ggx(parameters[1].value, parameters[2].value.x,
                                                  parameters[0].value.x)));
}

FieldModel measured_from(std::optional<std::string_view> rest, std::string_view words) {
    if (!rest || rest->empty()) {
        throw program::UsageError(fmt::format(
            "--model {}: found no file, expected measured:FILE, a .binary file of the MERL "
            "database",
            words));
    }
    return lobes_model(
        "measured", factors::lobes_of(factors::MerlBrdf::read(std::filesystem::path(*rest))));
}

}  // namespace

FieldModel model_from_words(std::string_view words) {
    const std::size_t colon = words.find(':');
    const std::string name(words.substr(0, colon));
    const auto rest =
        colon == std::string_view::npos ? std::nullopt : std::optional(words.substr(colon + 1));
    const std::vector<std::string> names{"lambert", "phong", "ggx", "measured"};
    const auto known = std::find(names.begin(), names.end(), name);
    switch (known - names.begin()) {
        case 0:
            return lambert_from(rest, words);
        case 1:
            return phong_from(rest, words);
        case 2:
            return ggx_from(rest, words);
        case 3:
            return measured_from(rest, words);
        default:
            throw program::UsageError(fmt::format("--model is '{}', expected {}", words,
                                                  text::expected_name(name, names, "models")));
    }
}

}  // namespace relume::materials
