#include "protocol/curve/parameter.h"

#include <fmt/format.h>

namespace relume::curve {
namespace {

// A bound that went through single precision still counts as the bound.
constexpr double kRounding = 1e-7;

}  // namespace

ParameterValues usual_values(std::span<const Parameter> parameters) {
    ParameterValues values;
    for (const Parameter& parameter : parameters) {
        values.emplace_back(parameter.usual);
    }
    return values;
}

void require_in_range(std::span<const Parameter> parameters,
                      std::span<const Imath::V3d> values,
                      std::string_view what) {
    if (values.size() != parameters.size()) {
        throw CurveError(fmt::format("{}: found {} parameters, expected {}", what,
                                     values.size(), parameters.size()));
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& parameter = parameters[i];
        for (int c = 0; c < 3; ++c) {
            const double value = values[i][c];
            if (!(value >= parameter.lowest * (1 - kRounding) &&
                  value <= parameter.highest * (1 + kRounding))) {
                throw CurveError(fmt::format("{}: found {} for {}, expected {} … {}", what,
                                             value, parameter.name, parameter.lowest,
                                             parameter.highest));
            }
        }
        if (!parameter.has_colours && values[i] != Imath::V3d(values[i].x)) {
            throw CurveError(fmt::format("{}: found three values for {}, expected one number",
                                         what, parameter.name));
        }
    }
}

}  // namespace relume::curve
