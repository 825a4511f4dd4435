// A material field as a file, NAME.material (../materials.md). Thread-safe.
#pragma once

#include "protocol/tripling/error.h"
#include "protocol/tripling/material_field.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace relume::tripling {

// Of a file; what it holds takes at most half as much again in memory.
inline constexpr std::size_t kMostMaterialBytes = std::size_t{1} << 31;

// Throws MaterialFileError where the field is not one that a reader takes: a name, lobes or
// colours out of range, an entry too few, a square without its parent, a value that is not
// finite, or more than kMostMaterialBytes.
[[nodiscard]] std::vector<std::byte> bytes_from_field(const MaterialField& field);

// Lengths are checked before anything is allocated for them, and everything that kernels rely
// on. Throws MaterialFileError, which begins with `file`.
[[nodiscard]] MaterialField field_from_bytes(std::string_view file,
                                             std::span<const std::byte> bytes);

// Whole or not at all. Throws MaterialFileError, files::FileError.
void write_material_file(const std::filesystem::path& path, const MaterialField& field);
// Throws MaterialFileError, and files::FileError for what cannot be read.
[[nodiscard]] MaterialField read_material_file(const std::filesystem::path& path);

// Whether a file's beginning is that of a material.
[[nodiscard]] bool begins_as_material(std::string_view beginning);

}  // namespace relume::tripling
