// Triangles of one material, in world space.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {

using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
    std::string name;
    std::vector<Imath::V3f> positions;  // finite
    std::vector<Imath::V3f> normals;    // per vertex, unit; empty: flat shading
    std::vector<Imath::V2f> uvs;        // per vertex, v upwards; empty: (0, 0)
    std::vector<Imath::V3f> colours;    // per vertex, linear; empty: white
    std::vector<Triangle> triangles;    // indices < positions.size(), none degenerate
    std::uint32_t material = 0;         // index into Scene::materials
};

}  // namespace relume::scene
