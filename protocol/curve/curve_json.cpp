#include "protocol/curve/curve_json.h"

#include "protocol/base/text/near_names.h"
#include "protocol/base/text/strict_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relume::curve {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& place,
                       std::string_view found,
                       std::string_view expected) {
    throw CurveError(fmt::format("{}: found {}, expected {}", place, found, expected));
}

// The shortest decimal that reads back as this float, as the double that prints so.
double shortest_double(float value) {
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
    double read = 0;
    std::from_chars(std::begin(text), end, read);
    return read;
}

double number_from(const json& value, const std::string& place) {
    if (!value.is_number()) {
        fail(place, text::quote(value), "a number");
    }
    return value.get<double>();
}

Imath::V3d colour_from(const json& value, const std::string& place) {
    if (value.is_number()) {
        return Imath::V3d(value.get<double>());
    }
    if (!value.is_array() || value.size() != 3) {
        fail(place, text::quote(value), "a number or [red, green, blue]");
    }
    return {number_from(value[0], place), number_from(value[1], place),
            number_from(value[2], place)};
}

const json& member(const json& object, std::string_view key, const std::string& place) {
    const auto found = object.find(key);
    if (found == object.end()) {
        fail(place, fmt::format("no key {}", key), "one");
    }
    return *found;
}

void require_object(const json& value, const std::string& place) {
    if (!value.is_object()) {
        fail(place, text::quote(value), "an object");
    }
}

void refuse_other_keys(const json& object,
                       const std::vector<std::string>& known,
                       const std::string& place) {
    for (const auto& item : object.items()) {
        if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
            fail(place, fmt::format("key {}", text::quote(item.key())),
                 text::expected_name(item.key(), known, "keys"));
        }
    }
}

template <typename Table>
auto word_from(const Table& table, const json& value, const std::string& place) {
    if (!value.is_string()) {
        fail(place, text::quote(value), table.alternatives());
    }
    const auto& word = value.get_ref<const std::string&>();
    const auto found = table.value(word);
    if (!found) {
        const auto words = table.words();
        fail(place, text::quote(value),
             text::expected_name(word, std::vector<std::string>(words.begin(), words.end()),
                                 "words"));
    }
    return *found;
}

json json_from_values(const Imath::V3d& value, bool has_colours) {
    if (!has_colours || (value.x == value.y && value.y == value.z)) {
        return value.x;
    }
    return json::array({value.x, value.y, value.z});
}

void append_parameters(json& object,
                       std::span<const Parameter> parameters,
                       const ParameterValues& values) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        object[std::string(parameters[i].name)] =
            json_from_values(values[i], parameters[i].has_colours);
    }
}

// `object` may have `other_keys` beside the parameters, and nothing else.
ParameterValues parameters_from(const json& object,
                                std::span<const Parameter> parameters,
                                std::vector<std::string> other_keys,
                                const std::string& place) {
    ParameterValues values;
    for (const Parameter& parameter : parameters) {
        const json& value = member(object, parameter.name, place);
        const std::string way = fmt::format("{}.{}", place, parameter.name);
        values.push_back(parameter.has_colours ? colour_from(value, way)
                                               : Imath::V3d(number_from(value, way)));
        other_keys.emplace_back(parameter.name);
    }
    refuse_other_keys(object, other_keys, place);
    require_in_range(parameters, values, place);
    return values;
}

std::vector<BrdfCurve> curves_from(const json& value, const std::string& place) {
    require_object(value, place);
    std::vector<BrdfCurve> curves;
    for (const auto& item : value.items()) {
        const std::string way = fmt::format("{}.{}", place, item.key());
        curves.push_back({word_from(kCurveNames, json(item.key()), way),
                          curve_from_json(item.value(), way)});
    }
    return curves;
}

}  // namespace

nlohmann::json json_from_curve(const Curve& curve) {
    json samples = json::array();
    const bool is_grey = curve.is_grey();
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        const Imath::V3f sample = curve.sample(k);
        if (is_grey) {
            samples.push_back(shortest_double(sample.x));
        } else {
            samples.push_back(json::array({shortest_double(sample.x), shortest_double(sample.y),
                                           shortest_double(sample.z)}));
        }
    }
    return samples;
}

Curve curve_from_json(const nlohmann::json& value, const std::string& place) {
    if (!value.is_array()) {
        fail(place, text::quote(value), fmt::format("an array of {} samples", kCurveSamples));
    }
    if (value.size() != kCurveSamples) {
        fail(place, fmt::format("{} samples", value.size()), fmt::format("{}", kCurveSamples));
    }
    Curve curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        const std::string way = fmt::format("{}[{}]", place, k);
        const Imath::V3d sample = colour_from(value[k], way);
        for (int c = 0; c < 3; ++c) {
            if (!(sample[c] >= 0 && sample[c] <= static_cast<double>(kMostCurveValue))) {
                fail(way, fmt::format("{}", sample[c]), fmt::format("0 … {}", kMostCurveValue));
            }
        }
        curve.set_sample(k, Imath::V3f(sample));
    }
    return curve;
}

nlohmann::json json_from_shaped_curve(const ShapedCurve& shaped) {
    json object{{"shape", kCurveShapeNames.name(shaped.shape)}};
    append_parameters(object, parameters_of(shaped.shape), shaped.values);
    return object;
}

ShapedCurve shaped_curve_from_json(const nlohmann::json& value, const std::string& place) {
    require_object(value, place);
    const CurveShape shape =
        word_from(kCurveShapeNames, member(value, "shape", place), place + ".shape");
    return {shape, parameters_from(value, parameters_of(shape), {"shape"}, place)};
}

nlohmann::json json_from_curve_brdf(const CurveBrdf& brdf) {
    json object{{"model", kCurveModelNames.name(brdf.model())}};
    append_parameters(object, parameters_of(brdf.model()), brdf.parameters());
    for (std::size_t i = 0; i < brdf.curves().size(); ++i) {
        if (!brdf.is_of_parameters(i)) {
            const BrdfCurve& curve = brdf.curves()[i];
            object["curves"][std::string(curve.name())] = json_from_curve(curve.curve);
        }
    }
    return object;
}

CurveBrdf curve_brdf_from_json(const nlohmann::json& value, const std::string& place) {
    require_object(value, place);
    const CurveModel model =
        word_from(kCurveModelNames, member(value, "model", place), place + ".model");
    ParameterValues values =
        parameters_from(value, parameters_of(model), {"model", "curves"}, place);
    std::vector<BrdfCurve> curves;
    if (model == CurveModel::measured || value.contains("curves")) {
        curves = curves_from(member(value, "curves", place), place + ".curves");
    }
    try {
        if (model == CurveModel::measured) {
            return CurveBrdf::measured(std::move(curves));
        }
        CurveBrdf brdf = CurveBrdf::from_parameters(model, std::move(values));
        for (const BrdfCurve& curve : curves) {
            brdf = brdf.with_curve(brdf.index_of(curve.name()), curve.curve);
        }
        return brdf;
    } catch (const CurveError& error) {
        throw CurveError(fmt::format("{}: {}", place, error.what()));
    }
}

}  // namespace relume::curve
