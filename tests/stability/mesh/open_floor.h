// A floor of one material under the open sky, and what it reflects by its own BRDF.
#pragma once

#include "precompute/scene/bsdf.h"
#include "precompute/scene/scene.h"
#include "protocol/light/light_cubemap.h"
#include "server/view/view.h"
#include "tests/stability/relit_image.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::stability {

// A square of side 4 around the origin, y up. Its vertices see the same.
[[nodiscard]] scene::Scene open_floor(const scene::Material& material);
// The material's BSDF; it has no textures.
[[nodiscard]] scene::Bsdf bsdf_of(const scene::Material& material);

// From this height in degrees over the horizon, towards −Z, at the middle of the floor, which
// fills the image.
[[nodiscard]] view::Look look_at_floor(double elevation_degrees,
                                       double fov_degrees,
                                       std::uint32_t side);

// What is sent along `to_viewer`: a plain sum over 4×4 directions in each texel of the light.
[[nodiscard]] Imath::V3d reflected(const scene::Bsdf& bsdf,
                                   const Imath::V3f& to_viewer,
                                   const light::LightCubemap& light);
// An image of that.
[[nodiscard]] RelitImage reflected_image(const scene::Bsdf& bsdf,
                                         const view::Look& look,
                                         const light::LightCubemap& light);

}  // namespace relume::stability
