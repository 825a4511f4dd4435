// The statements of an OBJ file that make polygons.
#pragma once

#include "precompute/scene/polygons/polygon_mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::scene::obj {

struct ObjFile {
    PolygonMesh mesh{};
    std::vector<std::string>
        materials{};  // names in `usemtl`; Polygon::material is one of them
    std::vector<std::string> libraries{};  // what `mtllib` says, one for each statement
    std::uint64_t points_and_lines = 0;
    bool has_free_forms = false;    // curves or surfaces, which are not read
    bool has_byte_colours = false;  // colours reached beyond 1 and were taken as 0 to 255
};

// Reads at most `max_bytes`. Positions are doubles, as the text has them; colours behind them
// (`v x y z r g b`) are display-referred and made linear. Throws SceneError with the line:
// corrupt_file for what is no number, index_out_of_range for a corner that refers to nothing.
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& path, std::uint64_t max_bytes);

}  // namespace relume::scene::obj
