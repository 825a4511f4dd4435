// The shared cases of what a state lights with: protocol/wire/vectors.
#include "protocol/light/disc_coverage.h"
#include "protocol/light/light_rig.h"
#include "protocol/wire/room_state.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numbers>

namespace relume::light {
namespace {

using nlohmann::json;

json vectors_from_file(const std::string& name) {
    std::ifstream file(std::string(RELUME_WIRE_VECTORS) + "/" + name);
    return json::parse(file);
}

float radians_from_degrees(double degrees) {
    return static_cast<float>(degrees * std::numbers::pi / 180);
}

std::shared_ptr<const PrefilteredEnvironment> environment_from_json(const json& map,
                                                                    std::uint32_t n) {
    MapImage image{map.at("width"), map.at("height"), map.at("texels")};
    return std::make_shared<PrefilteredEnvironment>(
        std::make_shared<EnvironmentMap>(std::move(image), Projection::lat_long), n);
}

LightRig rig_of(const wire::RoomState& state, const json& maps, std::uint32_t n) {
    LightRig rig;
    rig.rotation = Imath::Quatf(state.rotation.quaternion);
    rig.environment_scale = Imath::V3f(state.environment.gain * state.environment.tint);
    const bool solo = wire::any_solo(state.lights);
    if (!solo) {
        rig.environment = environment_from_json(maps.at(state.environment.name), n);
        if (state.blend.name) {
            rig.blend = environment_from_json(maps.at(*state.blend.name), n);
            rig.blend_amount = static_cast<float>(state.blend.amount);
        }
    }
    for (const auto& [id, light] : state.lights) {
        if (wire::lights_now(light, solo)) {
            rig.lights.push_back(
                {.direction = Imath::V3f(light.direction),
                 .angular_radius_radians = radians_from_degrees(light.angular_radius_degrees),
                 .radiance = Imath::V3f(light.gain * light.tint * light.radiance)});
        }
    }
    return rig;
}

TEST(Lightings, TexelsAreThoseOfTheSharedCases) {
    const json vectors = vectors_from_file("lightings.json");
    const std::uint32_t n = vectors.at("face_resolution");
    for (const json& c : vectors.at("cases")) {
        SCOPED_TRACE(c.at("name"));
        LightCubemap cubemap;
        evaluate(rig_of(wire::room_state_from_json(c.at("state")), vectors.at("maps"), n), n,
                 cubemap);
        for (std::size_t colour = 0; colour < 3; ++colour) {
            const auto expected = c.at("texels").at(colour).get<std::vector<float>>();
            const auto found = cubemap.planes()[colour];
            ASSERT_EQ(found.size(), expected.size());
            // The contract's own bound.
            const float tolerance = 1e-4F * *std::max_element(expected.begin(), expected.end());
            for (std::size_t texel = 0; texel < expected.size(); ++texel) {
                EXPECT_NEAR(found[texel], expected[texel], tolerance)
                    << "colour " << colour << ", texel " << texel;
            }
        }
    }
}

TEST(Lightings, ProfilesOfRoundLightsAreThoseOfTheSharedCases) {
    for (const json& c : vectors_from_file("light_profiles.json")) {
        const float edge = c.at("edge");
        const DiscCoverage coverage(
            chord_from_angle(radians_from_degrees(c.at("angular_radius_degrees"))), edge);
        const auto distances = c.at("distances").get<std::vector<float>>();
        const auto expected = c.at("coverages").get<std::vector<float>>();
        ASSERT_EQ(distances.size(), expected.size());
        for (std::size_t i = 0; i < distances.size(); ++i) {
            // Distances are rounded to 32 bits, and the profile is as steep as its edge.
            EXPECT_NEAR(coverage.at(distances[i]), expected[i], 1e-6F + 4e-7F / edge)
                << c << " at " << distances[i];
        }
    }
}

}  // namespace
}  // namespace relume::light
