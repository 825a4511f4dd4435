// A small light walks from face to face, over an edge and through a corner.
#include "protocol/relighting/strategy.h"
#include "tests/stability/open_plane.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::stability {
namespace {

constexpr float kSteps = 20;  // to a texel
constexpr int kReach = 60;    // steps to either side
constexpr float kRadiusDegrees = 1;

struct Path {
    const char* name;
    Imath::V3f middle;  // on the cube
    Imath::V3f along;   // on the cube, a texel being 2/n of it
};
const Path kPaths[] = {{"edge", {1, 1, 0.23F}, {-1, 0.2F, 0.1F}},
                       {"corner", {1, 1, 1}, {-1, 0.3F, 0.7F}}};

light::AreaLight light_at(const Path& path, int step, std::uint32_t n) {
    const float texels = static_cast<float>(step) / kSteps;
    return {.direction = path.middle + path.along * (texels * 2 / static_cast<float>(n)),
            .angular_radius_radians = radians_from_degrees(kRadiusDegrees),
            .radiance = Imath::V3f(1000)};
}

light::LightCubemap covered(std::uint32_t n, const light::AreaLight& light) {
    light::LightCubemap cubemap(n);
    light::add_area_light(light, cubemap);
    return cubemap;
}

struct Walk {
    double largest_step = 0;   // relative change of brightness between steps
    double largest_error = 0;  // of brightness, as a part of the tolerance
    double energy_error = 0;   // of ∫L dω, relative
};

template <typename CubemapOf>
Walk walk(OpenPlane& plane, const Path& path, CubemapOf cubemap_of) {
    const std::uint32_t n = plane.face_resolution();
    Walk result;
    double before = 0;
    for (int step = -kReach; step <= kReach; ++step) {
        const light::AreaLight light = light_at(path, step, n);
        const light::LightCubemap cubemap = cubemap_of(n, light);
        const double now = plane.brightness(cubemap);
        const double expected = OpenPlane::expected_brightness(light);
        if (step > -kReach) {
            result.largest_step = std::max(result.largest_step, std::abs(now / before - 1));
        }
        result.largest_error =
            std::max(result.largest_error,
                     std::abs(now / expected - 1) / plane.tolerance(light.direction));
        const double energy = double{light.radiance.x} * light::solid_angle_sr(light);
        result.energy_error =
            std::max(result.energy_error, std::abs(total_energy(cubemap).x / energy - 1));
        before = now;
    }
    return result;
}

// Relative. A cone of radius R (the edge of a disc smaller than a sample, half a texel) that
// moves by d takes the part 3d/πR of its light along, across two texels at most, whose cosθ
// differ by tanθ·4/n.
double largest_step_on(const Path& path, std::uint32_t n) {
    double tangent = 0;
    for (int step = -kReach; step <= kReach; ++step) {
        const double cosine = double{light_at(path, step, n).direction.normalized().y};
        tangent = std::max(tangent, std::sqrt(1 - cosine * cosine) / cosine);
    }
    const double step_of_radius = 2 / double{kSteps};
    return 3 / std::numbers::pi * step_of_radius * tangent * 4 / static_cast<double>(n);
}

// Error of NWA-10 with the light on the border (within half a texel), over that elsewhere on
// the path.
double border_cost(const OpenPlane& plane, const Path& path) {
    std::vector<Lighting> on_border;
    std::vector<Lighting> elsewhere;
    for (int step = -kReach; step <= kReach; ++step) {
        const std::uint32_t n = plane.face_resolution();
        auto& list = std::abs(static_cast<float>(step)) <= kSteps / 4 ? on_border : elsewhere;
        list.push_back(lighting_from_cubemap(covered(n, light_at(path, step, n))));
    }
    const auto mean_error = [&](std::span<const Lighting> lightings) {
        constexpr std::uint32_t kColumns = 10;
        const auto exact = exact_images(plane.scene(), lightings);
        const RelitRun run = relight_in_turn(
            plane.scene(),
            {.method = relighting::Method::nwa, .priority = relighting::Priority::area},
            kColumns, lightings);
        double sum = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            sum += distance(run.images[i], exact[i]) / norm(exact[i]);
        }
        return sum / static_cast<double>(exact.size());
    };
    return mean_error(on_border) / mean_error(elsewhere);
}

Outcome provoke(Workbench& workbench) {
    OpenPlane plane(workbench);
    Outcome outcome;
    for (const Path& path : kPaths) {
        const Walk whole = walk(plane, path, covered);
        const Walk pointwise = walk(plane, path, point_sampled);
        const double largest_step = largest_step_on(path, plane.face_resolution());
        const std::string name(path.name);
        outcome.findings.push_back({name + ", NWA-10: error on the border, of that beside it",
                                    Sense::at_least, 1, border_cost(plane, path),
                                    "wavelets end at the border; more of them are needed"});
        outcome.findings.push_back(
            {name + ", one texel takes all: largest change of brightness at 1/20 texel",
             Sense::at_least, largest_step, pointwise.largest_step,
             "the bound that coverage must keep"});
        outcome.findings.push_back(
            {name + ", coverage: the same", Sense::at_most, largest_step, whole.largest_step,
             "a cone of radius R moved by d: the part 3d/πR of its light moves, across two "
             "texels, where cosθ differs by tanθ·4/n"});
        outcome.findings.push_back({name + ": brightness off Eρcosθ/π, of what texels allow",
                                    Sense::at_most, 1, whole.largest_error,
                                    "tanθ·√2/n, and 1 % for the stored transport"});
        outcome.findings.push_back({name + ": ∫L dω off radiance × solid angle, relative",
                                    Sense::at_most, 1e-5, whole.energy_error,
                                    "some 64 texels summed and scaled in float, ε each"});
        workbench.progress("face_crossing", 0.5);
        for (const int step : {-kReach / 2, 0, kReach / 2}) {
            const auto resolution = plane.face_resolution();
            const light::AreaLight light = light_at(path, step, resolution);
            outcome.tiles.push_back(
                {image_of_faces(covered(resolution, light).radiance, resolution),
                 fmt::format("{}, {:+.1f} texels", path.name,
                             static_cast<float>(step) / kSteps),
                 -7});
        }
    }
    return outcome;
}

}  // namespace

Failure face_crossing() {
    return {.name = "face_crossing",
            .what = "a small light jumps or fades where it crosses from face to face",
            .scene = "an open white plane; a light of 1 degree walks in steps of 1/20 texel",
            .provoke = provoke};
}

}  // namespace relume::stability
