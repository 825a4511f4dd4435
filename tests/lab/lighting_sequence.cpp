#include "tests/lab/lighting_sequence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace relume::lab {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
const Imath::V3f kUp(0, 1, 0);

Imath::Quatf yaw(float radians) {
    Imath::Quatf rotation;
    rotation.setAxisAngle(kUp, radians);
    return rotation;
}

light::LightRig turned(const LightingSources& sources, float radians) {
    light::LightRig rig;
    rig.environment = sources.environment;
    rig.rotation = yaw(radians);
    return rig;
}

light::AreaLight area_light(const Imath::V3f& direction, float radius_degrees, float radiance) {
    return {.direction = direction.normalized(),
            .angular_radius_radians = radius_degrees * kPi / 180,
            .radiance = Imath::V3f(radiance)};
}

// Speed ∝ sin²: one full turn over the first 100 images, at rest for the last 50.
float slow_fast_slow_angle(std::uint32_t image) {
    constexpr float kMoving = 100;
    const float t = std::min(static_cast<float>(image) / kMoving, 1.0F);
    return 2 * kPi * t - std::sin(2 * kPi * t);
}

LightingSequence slow_fast_slow(const LightingSources& sources) {
    return {.name = "slow-fast-slow",
            .description =
                "one turn about the vertical in 100 images, speed as sin^2, "
                "then 50 images of rest",
            .images = 150,
            .rests_from = 100,
            .rig = [sources](std::uint32_t image) {
                return turned(sources, slow_fast_slow_angle(image));
            }};
}

LightingSequence moving_light(const LightingSources& sources) {
    return {.name = "moving-light",
            .description =
                "a light of 2 degrees radius crosses the sky over a dim environment, "
                "over face edges, then 25 images of rest",
            .images = 100,
            .rests_from = 75,
            .rig = [sources](std::uint32_t image) {
                const float t = static_cast<float>(std::min(image, 75U)) / 75;
                const float angle = kPi * (0.1F + 0.8F * t);
                light::LightRig rig = turned(sources, 0);
                rig.environment_scale = Imath::V3f(0.1F);
                rig.lights = {area_light({std::cos(angle), std::sin(angle), 0.35F}, 2, 400)};
                return rig;
            }};
}

LightingSequence switching(const LightingSources& sources) {
    return {.name = "switching",
            .description = "three lights of radiance 3000 switched on and off every 10 images",
            .images = 120,
            .rests_from = 120,
            .rig = [sources](std::uint32_t image) {
                light::LightRig rig = turned(sources, 0);
                const std::uint32_t phase = image / 10;
                const Imath::V3f directions[] = {{1, 1, 0.2F}, {-1, 0.6F, 0.5F}, {0, 1, -1}};
                for (std::uint32_t i = 0; i < 3; ++i) {
                    if (((phase >> i) & 1U) != 0) {
                        rig.lights.push_back(area_light(directions[i], 4, 3000));
                    }
                }
                return rig;
            }};
}

LightingSequence random_edits(const LightingSources& sources) {
    return {.name = "random-edits",
            .description = "every few images a jump to a random rotation, gain and light",
            .images = 120,
            .rests_from = 120,
            .rig = [sources](std::uint32_t image) {
                std::mt19937_64 random(sources.seed * 1000 + image / 4);
                std::uniform_real_distribution<float> uniform(0, 1);
                std::normal_distribution<float> normal;
                light::LightRig rig = turned(sources, 2 * kPi * uniform(random));
                rig.environment_scale = Imath::V3f(std::exp2(4 * uniform(random) - 2));
                const Imath::V3f direction(normal(random), std::abs(normal(random)),
                                           normal(random));
                rig.lights = {area_light(direction, 1 + 20 * uniform(random),
                                         std::exp2(10 * uniform(random)))};
                return rig;
            }};
}

using Maker = LightingSequence (*)(const LightingSources&);
constexpr Maker kMakers[] = {slow_fast_slow, moving_light, switching, random_edits};

}  // namespace

std::vector<std::string> sequence_names() {
    std::vector<std::string> names;
    for (const Maker make : kMakers) {
        names.push_back(make({}).name);
    }
    return names;
}

LightingSequence make_sequence(std::string_view name, const LightingSources& sources) {
    for (const Maker make : kMakers) {
        LightingSequence sequence = make(sources);
        if (sequence.name == name) {
            return sequence;
        }
    }
    throw std::invalid_argument(fmt::format("sequence '{}': expected one of {}", name,
                                            fmt::join(sequence_names(), ", ")));
}

}  // namespace relume::lab
