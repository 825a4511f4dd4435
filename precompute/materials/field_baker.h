// Material fields from models: every pair of a normal and a reflection, in wavelets.
#pragma once

#include "precompute/materials/field_model.h"
#include "precompute/materials/texel_samples.h"
#include "protocol/tripling/material_field.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::materials {

struct FieldParameters {
    std::uint32_t face_resolution = 64;  // of the direction to the light
    std::uint32_t normal_side = 4;       // of the grid of normals, where the model has them
    std::uint32_t reflection_side = 8;   // of the grid of reflections, likewise
    double energy_fraction = 0.99;       // of the squares of an entry, kept at least
    std::uint32_t samples_per_side = 2;  // of a texel
    std::size_t most_bytes = std::size_t{1} << 30;  // that the field may take in memory
};

// Grids as fine as the model's highlight asks for: a third of its width from node to node, and
// half of it where both directions count.
[[nodiscard]] FieldParameters usual_parameters(const FieldModel& model,
                                               std::uint32_t face_resolution);

// How much memory a field takes, before it is baked.
struct FieldSize {
    std::size_t entries = 0;         // of all lobes
    std::size_t expected_bytes = 0;  // as some entries have it, spread over all
    std::size_t bound_bytes = 0;     // whatever entries hold, and no more than `most_bytes`
};
[[nodiscard]] FieldSize field_size(const FieldModel& model, const FieldParameters& parameters);

struct FieldReport {
    std::size_t entries = 0;  // of all lobes
    std::size_t nonzero = 0;  // coefficients that are kept and not zero
    double sparsity = 0;      // nonzero over 6·n² an entry
    double least_energy = 1;  // that an entry keeps
};

// The texels of each lobe for a normal and a reflection: ∫_texel ρ·cos dω. [lobes][6·n²]
[[nodiscard]] std::vector<std::vector<float>> lobe_texels(const FieldModel& model,
                                                          const TexelSamples& samples,
                                                          const Imath::V3f& normal,
                                                          const Imath::V3f& reflection);

// With the threads of the calling arena; the same field on any number of them. Throws
// std::invalid_argument for parameters out of range, std::length_error where the field passes
// `most_bytes`.
[[nodiscard]] tripling::MaterialField bake_field(const FieldModel& model,
                                                 const FieldParameters& parameters,
                                                 FieldReport& report);

}  // namespace relume::materials
