// Materials that people edit in a small transport: points of them, and what these see.
#pragma once

#include "protocol/transport/materials_section.h"
#include "protocol/transport/seen_points.h"
#include "protocol/transport/visibility_field.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::test {

// Writes both files into the directory of a transport that is there, and the section into its
// manifest.
void add_materials(const std::filesystem::path& directory,
                   const transport::VisibilityFieldBuilder& visibility,
                   const transport::SeenPointsBuilder& points,
                   std::vector<transport::EditableRecord> editable);

// `metal`, a GGX of α = 0.3 without a diffuse part, and `cloth`, a glossy coat over a diffuse
// layer.
[[nodiscard]] std::vector<transport::EditableRecord> tiny_editable_materials();

// Puts both materials into an image transport: points in every other pixel, in random frames,
// each of which sees about two thirds of the texels above its surface. A pixel has one point of
// its whole, or one of each material.
void add_random_materials(const std::filesystem::path& directory,
                          std::uint32_t face_resolution = 8,
                          std::uint64_t seed = 1);

}  // namespace relume::test
