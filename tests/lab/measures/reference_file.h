// References on disk: they take minutes, and every change of the bake is measured by the same.
#pragma once

#include "tests/lab/measures/bake_reference.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relume::lab {

// A file name that stands for all a reference depends on: the scene's content, the lights and
// the options. Not for the code that traces it: delete the folder when that changes.
[[nodiscard]] std::string reference_file_name(const scene::Scene& scene,
                                              const std::vector<ReferenceLight>& lights,
                                              const ReferenceOptions& options);

// A float EXR whose parts lie below each other. Throws bake::BakeError, files::FileError.
void write_reference(const std::filesystem::path& path,
                     const BakeReference& reference,
                     const ReferenceOptions& options);
// None when it is not there, cannot be read, or is of another size or number of lights.
[[nodiscard]] std::optional<BakeReference> read_reference(const std::filesystem::path& path,
                                                          std::size_t lights,
                                                          const ReferenceOptions& options);

}  // namespace relume::lab
