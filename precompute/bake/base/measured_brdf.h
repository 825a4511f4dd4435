// A material's reflection as it was measured, in the place of the model that its scene gives
// it.
#pragma once

#include "precompute/factors/merl_brdf.h"
#include "precompute/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::bake {

struct MeasuredBrdf {
    std::string material;        // of the scene, by name: all that have it
    std::filesystem::path file;  // as it was named
    std::uint64_t content_hash = 0;
    factors::MerlBrdf brdf;
};

// From "MATERIAL=FILE", FILE in MERL's .binary layout (factors/merl_brdf.h). Throws
// program::UsageError for words that are not of that form; files::FileError and
// factors::FactorError, which name the file, for what cannot be read.
[[nodiscard]] MeasuredBrdf read_measured_brdf(std::string_view material_and_file);

// The last that is given for a material; null where none is.
[[nodiscard]] const MeasuredBrdf* measured_brdf_of(std::span<const MeasuredBrdf> measured,
                                                   const std::string& material);

// The part of light from everywhere that a surface reflects, by colour, at most 1.
[[nodiscard]] Imath::V3f albedo_of(const factors::MerlBrdf& brdf);

// The scene with matte materials of the measured albedo where measured ones are given: what
// paths see that meet such a surface. Throws program::UsageError for a material that the scene
// does not have.
[[nodiscard]] scene::Scene scene_with_albedos(const scene::Scene& scene,
                                              std::span<const MeasuredBrdf> measured);

}  // namespace relume::bake
