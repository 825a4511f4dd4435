// Which of the materials that people edit each pixel shows, to choose one by its place in the
// image: view/materials.png.
#pragma once

#include "precompute/bake/receivers/pixel/pixel_receivers.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::bake {

struct ShownMaterials {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    // By pixel: m + 1 where it shows the m-th material more than anything else, else 0.
    std::vector<std::uint8_t> most;
    std::vector<bool> in_view;  // by material: whether any pixel sees it
};

// `materials` are indices into the scene's `scene_material_count`, at most 16.
[[nodiscard]] ShownMaterials shown_materials(const PixelReceivers& pixels,
                                             const std::vector<std::uint32_t>& materials,
                                             std::size_t scene_material_count);

// Of the finished transport in `directory`. Throws BakeError, files::FileError.
void write_shown_materials(const std::filesystem::path& directory, const ShownMaterials& shown);

}  // namespace relume::bake
