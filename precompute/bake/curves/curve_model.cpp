#include "precompute/bake/curves/curve_model.h"

#include "precompute/factors/curve_factors.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_names.h"
#include "protocol/base/text/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

std::optional<double> number_from(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

// One number, or three with slashes.
Imath::V3d value_from(const std::string& option, std::string_view text) {
    const std::vector<std::string_view> parts = text::split(text, '/');
    std::vector<double> numbers;
    for (const std::string_view part : parts) {
        if (const auto number = number_from(part)) {
            numbers.push_back(*number);
        }
    }
    if (numbers.size() != parts.size() || (numbers.size() != 1 && numbers.size() != 3)) {
        throw program::UsageError(
            fmt::format("{}: '{}', expected a number, or red/green/blue", option, text));
    }
    return numbers.size() == 1 ? Imath::V3d(numbers[0])
                               : Imath::V3d(numbers[0], numbers[1], numbers[2]);
}

curve::CurveModel model_from(const std::string& option, std::string_view text) {
    std::string name(text);
    std::replace(name.begin(), name.end(), '-', '_');
    std::vector<std::string> known;
    const auto found = curve::kCurveModelNames.value(name);
    if (found && found != curve::CurveModel::measured) {
        return *found;
    }
    for (const std::string_view word : curve::kCurveModelNames.words()) {
        if (word != curve::kCurveModelNames.name(curve::CurveModel::measured)) {
            known.emplace_back(word);
        }
    }
    throw program::UsageError(fmt::format("{}: no model '{}'; expected {}", option, text,
                                          text::expected_name(name, known, "models")));
}

std::size_t parameter_from(const std::string& option,
                           std::span<const curve::Parameter> parameters,
                           std::string_view name) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (parameters[i].name == name) {
            return i;
        }
        known.emplace_back(parameters[i].name);
    }
    throw program::UsageError(
        fmt::format("{}: no parameter '{}'; expected {}", option, name,
                    text::expected_name(std::string(name), known, "parameters")));
}

nlohmann::json json_from(const factors::CurveErrors& errors) {
    return {{"relative_l2", errors.relative_l2}, {"logarithmic", errors.logarithmic}};
}

// A product of curves and a diffuse part. The notes tell the errors of both methods, so that
// whoever bakes can choose.
StatedModel factored(const MeasuredBrdf& measured, factors::CurveMethod method) {
    using factors::CurveMethod;
    const CurveMethod other = method == CurveMethod::homomorphic ? CurveMethod::nonnegative
                                                                 : CurveMethod::homomorphic;
    const auto name = [](CurveMethod of) {
        return std::string(factors::kCurveMethodNames.name(of));
    };
    factors::CurveFactorisation found = factors::factorise_curves(measured.brdf, method);
    const factors::CurveErrors otherwise =
        factors::factorise_curves(measured.brdf, other).errors;
    return {.brdf = std::move(found.brdf),
            .albedo = found.diffuse,
            .notes = {{"measured", measured.file.filename().string()},
                      {"factors", name(method)},
                      {"errors",
                       {{name(method), json_from(found.errors)},
                        {name(other), json_from(otherwise)}}},
                      {"unmeasured", found.unmeasured_count}}};
}

}  // namespace

curve::CurveBrdf curve_brdf_from_text(const std::string& option, const std::string& text) {
    const std::size_t colon = text.find(':');
    const curve::CurveModel model = model_from(option, std::string_view(text).substr(0, colon));
    const std::span<const curve::Parameter> parameters = curve::parameters_of(model);
    curve::ParameterValues values = curve::usual_values(parameters);
    if (colon != std::string::npos) {
        for (const std::string_view part :
             text::split(std::string_view(text).substr(colon + 1), ',')) {
            const std::size_t equals = part.find('=');
            if (equals == std::string_view::npos) {
                throw program::UsageError(
                    fmt::format("{}: '{}', expected parameter=value", option, part));
            }
            values[parameter_from(option, parameters, part.substr(0, equals))] =
                value_from(option, part.substr(equals + 1));
        }
    }
    try {
        return curve::CurveBrdf::from_parameters(model, std::move(values));
    } catch (const curve::CurveError& error) {
        throw program::UsageError(fmt::format("{}: {}", option, error.what()));
    }
}

scene::Bsdf bsdf_without_textures(const scene::Material& material) {
    scene::Material plain = material;
    plain.base_texture = plain.specular_texture = plain.exponent_texture =
        plain.surface_texture = plain.gloss_texture = plain.dielectric_texture =
            plain.dielectric_colour_texture = std::nullopt;
    return plain.bsdf_at({}, {}, {1, 1, 1});
}

curve::CurveBrdf curve_brdf_of(const scene::Material& material) {
    const scene::Bsdf bsdf = bsdf_without_textures(material);
    switch (material.model) {
        case scene::BsdfModel::phong:
            return curve::CurveBrdf::phong(bsdf.specular_colour(), bsdf.exponent());
        case scene::BsdfModel::ggx:
            return curve::CurveBrdf::ggx(bsdf.specular_colour(), bsdf.grazing(), bsdf.alpha());
        case scene::BsdfModel::lambert:
            break;
    }
    throw program::UsageError(
        fmt::format("--edit {0}: the material has no specular part to edit, expected "
                    "--model {0}=MODEL beside it",
                    material.name));
}

StatedModels::StatedModels(const CurveRequest& request, std::span<const MeasuredBrdf> measured)
    : factors_(request.factors) {
    for (const std::string& text : request.models) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
            throw program::UsageError(fmt::format("--model {}: expected MATERIAL=MODEL", text));
        }
        add(text.substr(0, equals), text.substr(equals + 1));
    }
    for (const MeasuredBrdf& one : measured) {
        add(one.material, &one);
    }
}

void StatedModels::add(const std::string& material, Stated stated) {
    if (!by_material_.emplace(material, std::move(stated)).second) {
        throw program::UsageError(fmt::format(
            "the material {} has two of --model and --measured, expected one", material));
    }
}

StatedModel StatedModels::take(const scene::Material& material) {
    const auto found = by_material_.find(material.name);
    if (found == by_material_.end()) {
        return {.brdf = curve_brdf_of(material), .is_of_scene = true};
    }
    const Stated stated = std::move(found->second);
    by_material_.erase(found);
    if (const auto* measured = std::get_if<const MeasuredBrdf*>(&stated)) {
        return factored(**measured, factors_);
    }
    const std::string& text = std::get<std::string>(stated);
    return {.brdf =
                curve_brdf_from_text(fmt::format("--model {}={}", material.name, text), text)};
}

void StatedModels::require_all_taken() const {
    if (!by_material_.empty()) {
        const std::string& material = by_material_.begin()->first;
        throw program::UsageError(
            fmt::format("--model or --measured of {0}: the material is not edited, expected "
                        "--edit {0} beside it",
                        material));
    }
}

}  // namespace relume::bake
