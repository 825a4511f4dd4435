// Small files of materials for all normals and views.
#pragma once

#include "precompute/materials/field_baker.h"
#include "precompute/materials/field_model.h"
#include "protocol/tripling/material_file.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace relume::net {

// FOLDER/STEM.material.
inline void write_small_material(const std::filesystem::path& folder,
                                 const std::string& stem,
                                 const materials::FieldModel& model,
                                 std::uint32_t face_resolution = 4) {
    materials::FieldReport report;
    tripling::write_material_file(folder / (stem + ".material"),
                                  materials::bake_field(model,
                                                        {.face_resolution = face_resolution,
                                                         .normal_side = 4,
                                                         .reflection_side = 5,
                                                         .energy_fraction = 1},
                                                        report));
}

}  // namespace relume::net
