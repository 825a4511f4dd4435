// A small transport of kind `mesh` made from a seed: a room with a box in it, of materials with
// one to five terms and one to four lobes, some with textures.
#pragma once

#include "protocol/transport/mesh_section.h"
#include "protocol/transport/surface.h"
#include "protocol/transport/vertex_clusters.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::test {

struct TinyMesh {
    transport::Surface surface;
    std::vector<transport::MaterialRecord> materials;
    std::vector<transport::Cluster> clusters;
};

// The same seed gives the same.
[[nodiscard]] TinyMesh tiny_mesh(std::uint64_t seed = 1);

// A whole directory of random light transport onto that mesh, which lies around (10, 20, 30) in
// the world and has twice its size there. Rooms begin inside, with images of 40×24 pixels. With
// a visibility of this face resolution, of random bits above the vertices' horizons, unless it
// is 0.
void write_tiny_mesh_transport(const std::filesystem::path& directory,
                               std::uint64_t seed = 1,
                               std::uint32_t visibility_resolution = 0);

}  // namespace relume::test
