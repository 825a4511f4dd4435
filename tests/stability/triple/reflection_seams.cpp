// A viewer goes around a point, so that the mirrored direction passes edges and corners of the
// cube that materials are tabulated on.
#include "protocol/light/area_light.h"
#include "protocol/tripling/direction_grid.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/stability/triple/lit_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::stability {
namespace {

constexpr std::uint32_t n = 32;
constexpr std::uint32_t kSide = 17;

// On a great circle through edges and next to corners.
Imath::V3f around(double part) {
    const double angle = 2 * std::numbers::pi * part;
    return Imath::V3f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                      static_cast<float>(std::cos(angle - 0.8)))
        .normalized();
}

Imath::V3f nearest_node(const tripling::DirectionGrid& grid, const Imath::V3f& direction) {
    const auto near = grid.nodes_near(direction);
    return grid.direction(
        std::max_element(near.begin(), near.end(), [](const auto& a, const auto& b) {
            return a.weight < b.weight;
        })->index);
}

Outcome provoke(Workbench& workbench) {
    const int steps = workbench.choose(360, 2880);
    light::LightCubemap light = constant_sky(n, 0.2F);
    light::add_area_light({.direction = Imath::V3f(1, 1, 1).normalized(),
                           .angular_radius_radians = radians_from_degrees(12),
                           .radiance = Imath::V3f(20)},
                          light);
    light::add_area_light({.direction = Imath::V3f(-1, 0.1F, -1).normalized(),
                           .angular_radius_radians = radians_from_degrees(12),
                           .radiance = Imath::V3f(20)},
                          light);
    // Phong has no horizon of the normal, so that all directions count.
    const LitPoint above(n, {0, 1, 0}, [](const Imath::V3f&) { return true; });
    const materials::FieldModel model = materials::phong_model(20);
    const triple::TexelMaterial material = texel_material(model, n, 1, kSide, 2);
    const materials::TexelSamples samples(n, 2);
    const tripling::DirectionGrid grid(kSide);
    double before[3] = {};
    double jumps[3] = {};
    double farthest = 0;
    double highest = 0;
    for (int i = 0; i <= steps; ++i) {
        const Imath::V3f reflection = around(static_cast<double>(i) / steps);
        const double now[3] = {above.by_model(model, samples, light, reflection),
                               above.shown(material, light, reflection),
                               above.shown(material, light, nearest_node(grid, reflection))};
        highest = std::max(highest, now[0]);
        farthest = std::max(farthest, std::abs(now[1] - now[0]));
        for (int way = 0; way < 3; ++way) {
            if (i > 0) {
                jumps[way] = std::max(jumps[way], std::abs(now[way] - before[way]));
            }
            before[way] = now[way];
        }
    }
    Outcome outcome;
    outcome.findings = {
        {"the nearest node: largest step, over the material's own", Sense::at_least, 2,
         jumps[2] / jumps[0], "a table jumps from node to node"},
        {"between nodes: the same", Sense::at_most, 1.25, jumps[1] / jumps[0],
         "weights are continuous, across edges and corners of the cube too"},
        {"between nodes: farthest from the material itself, over its brightest", Sense::at_most,
         0.05, farthest / highest, "nodes are a third of the highlight's width apart"},
    };
    return outcome;
}

}  // namespace

Failure reflection_seams() {
    return {.name = "reflection_seams",
            .what = "materials jump where the mirrored direction passes an edge of the cube",
            .scene =
                "Phong 20 under two lamps at a corner and an edge of the cube; the mirrored "
                "direction goes once around, n = 32",
            .provoke = provoke};
}

}  // namespace relume::stability
