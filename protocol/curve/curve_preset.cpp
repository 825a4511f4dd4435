#include "protocol/curve/curve_preset.h"

#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <string>

namespace relume::curve {
namespace {

using Imath::V3d;

CurvePreset conductor(std::string_view name, const V3d& n, const V3d& e) {
    return {name, CurveAngle::difference, {{1, {CurveShape::conductor, {n, e}}}}};
}

PresetPart part(double weight, CurveShape shape, double parameter) {
    return {weight, {shape, {V3d(parameter)}}};
}

std::vector<CurvePreset> make_presets() {
    return {
        conductor("gold", {0.21, 0.43, 1.38}, {3.272, 2.455, 1.914}),
        conductor("silver", {0.06, 0.06, 0.04}, {4.152, 3.586, 2.657}),
        conductor("copper", {0.30, 1.02, 1.24}, {3.205, 2.577, 2.397}),
        conductor("aluminium", {1.279, 0.992, 0.649}, {7.246, 6.492, 5.414}),
        {"pearl",
         CurveAngle::half,
         {part(0.35, CurveShape::ggx, 0.03), part(0.65, CurveShape::beckmann, 0.35)}},
        {"satin",
         CurveAngle::half,
         {part(0.7, CurveShape::beckmann, 0.3), part(0.3, CurveShape::velvet, 0.5)}},
        {"velvet", CurveAngle::half, {part(1, CurveShape::velvet, 0.4)}},
    };
}

}  // namespace

Curve CurvePreset::curve() const {
    std::vector<Curve> curves;
    for (const PresetPart& part : parts) {
        curves.push_back(part.shape.curve(angle));
    }
    Curve sum;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        V3d value(0, 0, 0);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            value += parts[i].weight * V3d(curves[i].sample(k));
        }
        sum.set_sample(k, Imath::V3f(value));
    }
    return sum;
}

std::span<const CurvePreset> curve_presets() {
    static const std::vector<CurvePreset> presets = make_presets();
    return presets;
}

const CurvePreset& preset_from_name(std::string_view name) {
    std::vector<std::string> known;
    for (const CurvePreset& preset : curve_presets()) {
        if (preset.name == name) {
            return preset;
        }
        known.emplace_back(preset.name);
    }
    throw CurveError(fmt::format("preset of a curve: found {}, expected a preset: {}", name,
                                 text::expected_name(name, known, "presets")));
}

}  // namespace relume::curve
