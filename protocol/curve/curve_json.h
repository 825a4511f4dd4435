// Curves, shapes and BRDFs as JSON. Every fault is a CurveError that begins with `place`, the
// way to the value, and says what was found and what was expected. Keys that are not named here
// are refused. Samples come back with the bits that were written. Thread-safe.
#pragma once

#include "protocol/curve/curve_brdf.h"
#include "protocol/curve/curve_shape.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace relume::curve {

// 256 numbers where the curve is grey, else 256 arrays [red, green, blue].
[[nodiscard]] nlohmann::json json_from_curve(const Curve& curve);
// Takes both. The curve is valid.
[[nodiscard]] Curve curve_from_json(const nlohmann::json& value, const std::string& place);

// {"shape": word, and every parameter of the shape by its name: a number, or where it has
// colours a number or [red, green, blue]}.
[[nodiscard]] nlohmann::json json_from_shaped_curve(const ShapedCurve& shaped);
[[nodiscard]] ShapedCurve shaped_curve_from_json(const nlohmann::json& value,
                                                 const std::string& place);

// {"model": word, every parameter of the model, "curves": {name: samples, …}}. `curves` has
// those that are not of the parameters: all of a measured BRDF, and none of an analytic one
// that nobody edited, where the key is absent.
[[nodiscard]] nlohmann::json json_from_curve_brdf(const CurveBrdf& brdf);
[[nodiscard]] CurveBrdf curve_brdf_from_json(const nlohmann::json& value,
                                             const std::string& place);

}  // namespace relume::curve
