// Parameters of shapes and models: what each is called, whether it has three colours, and its
// range. Values are held as three numbers; those of one number are the same three times.
#pragma once

#include "protocol/curve/error.h"

#include <Imath/ImathVec.h>

#include <span>
#include <string_view>
#include <vector>

namespace relume::curve {

struct Parameter {
    std::string_view name;
    bool has_colours = false;  // red, green and blue may differ
    double lowest = 0;
    double highest = 0;
    double usual = 0;  // where nothing is said
};

// One a parameter, in their order.
using ParameterValues = std::vector<Imath::V3d>;

[[nodiscard]] ParameterValues usual_values(std::span<const Parameter> parameters);
// Throws CurveError, which begins with `what` and names the parameter, for another count and
// for a value out of its range or not the same three times where it has no colours.
void require_in_range(std::span<const Parameter> parameters,
                      std::span<const Imath::V3d> values,
                      std::string_view what);

}  // namespace relume::curve
