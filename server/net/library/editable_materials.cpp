#include "server/net/library/editable_materials.h"

#include "protocol/curve/curve_json.h"
#include "protocol/wire/sections/section_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace relume::net {
namespace {

using curve::CurveAngle;
using curve::CurveShape;
using wire::MaterialEdit;

constexpr std::size_t kChannels = 3;

Imath::V3d grey(double value) {
    return {value, value, value};
}

// Short in JSON, and finer than any image shows.
double rounded(double value) {
    constexpr double kDigits = 1e6;
    if (value == 0) {
        return 0;
    }
    const double scale = kDigits / std::pow(10.0, std::ceil(std::log10(std::abs(value))));
    return std::round(value * scale) / scale;
}

// What a parameter of a shape is called among the fields of a material.
std::string_view field_of_parameter(std::string_view parameter) {
    return parameter == "sigma" || parameter == "alpha" ? "roughness" : parameter;
}

// Of shapes that make sense over an angle.
std::vector<CurveShape> shapes_over(CurveAngle angle) {
    switch (angle) {
        case CurveAngle::half:
            return {CurveShape::beckmann, CurveShape::ggx, CurveShape::velvet,
                    CurveShape::cosine_power, CurveShape::constant};
        case CurveAngle::difference:
            return {CurveShape::conductor, CurveShape::dielectric, CurveShape::schlick,
                    CurveShape::constant};
        case CurveAngle::incidence:
        case CurveAngle::viewing:
        case CurveAngle::reflection:
        case CurveAngle::along_u:
        case CurveAngle::along_v:
            return {CurveShape::cosine_power, CurveShape::constant};
    }
    return {};
}

// Sets the shape that a model's parameters give its curve, where the curve is one.
void set_shape(const curve::CurveBrdf& brdf, CurveAngle angle, MaterialEdit& edit) {
    const auto parameter = [&](std::string_view name) {
        const std::span<const curve::Parameter> known = curve::parameters_of(brdf.model());
        const auto found =
            std::find_if(known.begin(), known.end(),
                         [&](const curve::Parameter& p) { return p.name == name; });
        return brdf.parameters().at(static_cast<std::size_t>(found - known.begin()));
    };
    switch (brdf.model()) {
        case curve::CurveModel::ggx:
            edit.roughness = parameter("alpha").x;
            edit.f0 = parameter("f0");
            edit.f90 = parameter("f90").x;
            edit.shape = angle == CurveAngle::half ? CurveShape::ggx : CurveShape::schlick;
            break;
        case curve::CurveModel::cook_torrance:
            edit.roughness = parameter("sigma").x;
            edit.n = parameter("n");
            edit.e = parameter("e");
            edit.shape =
                angle == CurveAngle::half ? CurveShape::beckmann : CurveShape::conductor;
            break;
        case curve::CurveModel::ashikhmin_shirley:
            edit.exponent = parameter(angle == CurveAngle::along_u ? "nu" : "nv").x;
            edit.f0 = parameter("rs");
            edit.shape = angle == CurveAngle::difference ? CurveShape::schlick
                                                         : CurveShape::cosine_power;
            break;
        case curve::CurveModel::phong:  // a shape times a colour
        case curve::CurveModel::measured:
            break;
    }
}

}  // namespace

wire::NumberTable samples_from_curve(const curve::Curve& curve) {
    wire::NumberTable samples{.columns = kChannels, .numbers = {}};
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        for (std::size_t channel = 0; channel < kChannels; ++channel) {
            samples.numbers.push_back(rounded(double{curve.rgb[channel][k]}));
        }
    }
    return samples;
}

curve::Curve curve_from_samples(const wire::NumberTable& samples) {
    curve::Curve curve;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        for (std::size_t channel = 0; channel < kChannels; ++channel) {
            curve.rgb[channel][k] =
                static_cast<float>(samples.numbers[k * kChannels + channel]);
        }
    }
    return curve;
}

curve::Curve edited_curve(const MaterialEdit& edit) {
    curve::Curve curve;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        for (std::size_t channel = 0; channel < kChannels; ++channel) {
            curve.rgb[channel][k] =
                static_cast<float>(edit.samples.numbers[k * kChannels + channel] *
                                   edit.tint[static_cast<int>(channel)]);
        }
    }
    return curve;
}

wire::MaterialEdit edit_as_baked(const transport::CurveRecord& record) {
    MaterialEdit edit;
    edit.samples = samples_from_curve({record.baked});
    const CurveAngle angle = curve::kCurveAngleNames.value(record.angle).value();
    const curve::CurveBrdf brdf = curve::curve_brdf_from_json(record.brdf, record.id);
    if (const auto index = brdf.index_of(angle); index && brdf.is_of_parameters(*index)) {
        set_shape(brdf, angle, edit);
    }
    return edit;
}

wire::EditableMaterial editable_material(const transport::CurveRecord& record) {
    const CurveAngle angle = curve::kCurveAngleNames.value(record.angle).value();
    wire::EditableMaterial material{.id = record.id,
                                    .name = record.name,
                                    .curve = record.curve,
                                    .angle = record.angle,
                                    .shapes = {},
                                    .presets = presets_over(angle),
                                    .baked = edit_as_baked(record)};
    for (const CurveShape shape : shapes_over(angle)) {
        material.shapes.emplace_back(curve::kCurveShapeNames.name(shape));
    }
    return material;
}

std::vector<Imath::V3d> shape_values(const MaterialEdit& edit) {
    switch (*edit.shape) {
        case CurveShape::beckmann:
        case CurveShape::ggx:
        case CurveShape::velvet:
            return {grey(edit.roughness)};
        case CurveShape::conductor:
            return {edit.n, edit.e};
        case CurveShape::dielectric:
            return {grey(edit.n.y)};
        case CurveShape::schlick:
            return {edit.f0, grey(edit.f90)};
        case CurveShape::cosine_power:
            return {grey(edit.exponent)};
        case CurveShape::constant:
            return {edit.value};
    }
    return {};
}

std::vector<std::string> presets_over(CurveAngle angle) {
    std::vector<std::string> names;
    for (const curve::CurvePreset& preset : curve::curve_presets()) {
        if (preset.angle == angle) {
            names.emplace_back(preset.name);
        }
    }
    return names;
}

nlohmann::json patch_from_preset(const curve::CurvePreset& preset) {
    if (preset.parts.size() != 1 || preset.parts[0].weight != 1) {
        wire::MaterialEdit drawn;
        drawn.samples = samples_from_curve(preset.curve());
        return {{"samples", wire::to_json(wire::kMaterials.entry, drawn)["samples"]}};
    }
    const curve::ShapedCurve& shaped = preset.parts[0].shape;
    nlohmann::json patch{{"shape", curve::kCurveShapeNames.name(shaped.shape)}};
    const std::span<const curve::Parameter> parameters = curve::parameters_of(shaped.shape);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const std::string key(field_of_parameter(parameters[i].name));
        const Imath::V3d& value = shaped.values[i];
        const bool has_colours = parameters[i].has_colours || key == "n";
        patch[key] =
            has_colours ? nlohmann::json{value.x, value.y, value.z} : nlohmann::json(value.x);
    }
    return patch;
}

}  // namespace relume::net
