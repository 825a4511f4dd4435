// A PLY file as polygons.
#pragma once

#include "precompute/scene/polygons/polygon_mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::scene::ply {

struct PlyFile {
    PolygonMesh mesh{};  // colours linear, positions as the file has them
    std::vector<std::string> pictures{};
    bool has_single_positions = false;  // floats, not doubles
    std::uint64_t short_faces = 0;      // of fewer than three corners
    bool has_face_colours = false;
    bool has_alpha = false;  // a vertex is not opaque
};

// Faces and triangle strips; vertex colours display-referred, whatever their type; texture
// coordinates by vertex or by corner. Throws SceneError: corrupt_file, index_out_of_range,
// no_geometry, too_large.
[[nodiscard]] PlyFile read_ply(const std::filesystem::path& path, std::uint64_t max_bytes);

}  // namespace relume::scene::ply
