// What the artist edits: an environment, another to blend into, turned and tinted, and lights.
#pragma once

#include "protocol/light/area_light.h"
#include "protocol/light/light_cubemap.h"
#include "protocol/light/prefiltered_environment.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace relume::light {

// Radiance from world direction ω:
//     environment_scale · ((1−a)·environment(R⁻¹ω) + a·blend(R⁻¹ω)) + Σ lights(ω)
// a is blend_amount if there is a blend, else 0. A missing environment is black. The
// pointers are shared so that a rig is cheap to copy and outlives a removed environment.
struct LightRig {
    std::shared_ptr<const PrefilteredEnvironment> environment;
    std::shared_ptr<const PrefilteredEnvironment> blend;
    float blend_amount = 0;                 // in [0, 1]
    Imath::Quatf rotation;                  // unit; turns environment and blend, not the lights
    Imath::V3f environment_scale{1, 1, 1};  // gain · tint
    std::vector<AreaLight> lights;          // radiance with their own gain and tint applied

    friend bool operator==(const LightRig&, const LightRig&) = default;
};

// The rig as a lighting cubemap of resolution n (out is reset to it).
// Throws std::invalid_argument if an environment was prefiltered for another resolution.
void evaluate(const LightRig& rig, std::uint32_t n, LightCubemap& out);

}  // namespace relume::light
