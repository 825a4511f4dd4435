#include "server/net/library/material_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace relume::net {
namespace {

constexpr std::array<std::string_view, 2> kParameters{"exponent", "roughness"};

// As people wrote it: 0.9, and not the double nearest to the float nearest to it.
Imath::V3d shortest(const Imath::V3f& colour) {
    const auto decimal = [](float value) { return std::stod(fmt::format("{}", value)); };
    return {decimal(colour.x), decimal(colour.y), decimal(colour.z)};
}

}  // namespace

MaterialName material_name_from_stem(const std::string& stem) {
    const std::size_t last = stem.rfind('-');
    if (last == std::string::npos) {
        return {.name = stem, .parameter = {}};
    }
    double number = 0;
    const char* const end = stem.data() + stem.size();
    const auto [rest, error] = std::from_chars(stem.data() + last + 1, end, number);
    const std::string before = stem.substr(0, last);
    for (const std::string_view parameter : kParameters) {
        if (error == std::errc() && rest == end && number > 0 && std::isfinite(number) &&
            before.size() > parameter.size() + 1 && before.ends_with(parameter) &&
            before[before.size() - parameter.size() - 1] == '-') {
            return {.name = before.substr(0, before.size() - parameter.size() - 1),
                    .parameter = std::string(parameter),
                    .step = number};
        }
    }
    return {.name = stem, .parameter = {}};
}

wire::OfferedMaterial MaterialFamily::description() const {
    wire::OfferedMaterial description{.name = name,
                                      .face_resolution = first().face_resolution(),
                                      .colours = {},
                                      .parameter = parameter};
    for (const Imath::V3f& colour : first().colours()) {
        description.colours.push_back(shortest(colour));
    }
    if (parameter) {
        for (const Step& step : steps) {
            description.steps.push_back(step.number);
        }
    }
    return description;
}

triple::Finish MaterialFamily::finish(std::optional<double> number,
                                      std::optional<std::vector<Imath::V3f>> colours) const {
    if (!number) {
        return {steps[steps.size() / 2].material->texels(), std::move(colours)};
    }
    const auto above = std::find_if(steps.begin(), steps.end(),
                                    [&](const Step& step) { return step.number >= *number; });
    if (above == steps.begin()) {
        return {above->material->texels(), std::move(colours)};
    }
    const Step& below = *std::prev(above);
    if (above == steps.end()) {
        return {below.material->texels(), std::move(colours)};
    }
    if (above->number == *number) {
        return {above->material->texels(), std::move(colours)};
    }
    const double amount =
        std::log(*number / below.number) / std::log(above->number / below.number);
    return {below.material->texels(), above->material->texels(), static_cast<float>(amount),
            std::move(colours)};
}

}  // namespace relume::net
