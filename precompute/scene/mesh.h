// Triangles of one material, in the frame of their scene (WorldFrame).
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::scene {

using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
    std::string name;
    std::vector<Imath::V3f> positions;  // finite
    std::vector<Imath::V3f> normals;    // per vertex, unit; empty: flat shading
    // Per vertex: xyz unit, along +u of the normal map; w = ±1, so that the texture's up is
    // w·normal×tangent. Made by finish_scene where a normal map needs them.
    std::vector<Imath::V4f> tangents;
    std::vector<Imath::V2f> uvs;  // first set, per vertex, v upwards; empty: (0, 0)
    std::vector<std::vector<Imath::V2f>> more_uvs;  // sets 1, 2, …, each like the first
    std::vector<Imath::V3f> colours;                // per vertex, linear; empty: white
    std::vector<float> opacities;     // per vertex, for materials with holes; empty: 1
    std::vector<Triangle> triangles;  // indices < positions.size(), none degenerate
    std::uint32_t material = 0;       // index into Scene::materials

    // Empty where the mesh has no such set.
    [[nodiscard]] std::span<const Imath::V2f> uv_set(std::size_t set) const {
        if (set == 0)
            return uvs;
        return set <= more_uvs.size() ? std::span<const Imath::V2f>(more_uvs[set - 1])
                                      : std::span<const Imath::V2f>();
    }
};

}  // namespace relume::scene
