#include "tests/support/surface_shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace relume::test {
namespace {

using transport::SurfaceMesh;

// Seen from outside, across × along points outwards.
constexpr std::array<std::array<int, 6>, 6> kFaces{{{0, 1, 0, 0, 0, 1},
                                                    {0, 0, 1, 0, 1, 0},
                                                    {0, 0, 1, 1, 0, 0},
                                                    {1, 0, 0, 0, 0, 1},
                                                    {1, 0, 0, 0, 1, 0},
                                                    {0, 1, 0, 1, 0, 0}}};

// Between −1 and 1, unevenly, and both ends kept.
float uneven(std::uint32_t i, std::uint32_t cells) {
    const double t = static_cast<double>(i) / cells;
    return static_cast<float>(2 * (t + 0.08 * std::sin(2 * std::numbers::pi * t)) - 1);
}

SurfaceMesh cube(std::uint32_t cells,
                 std::uint32_t materials,
                 const Imath::V3f& centre,
                 float half_side,
                 bool inwards) {
    SurfaceMesh mesh;
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    const std::uint32_t row = cells + 1;
    for (std::uint32_t f = 0; f < 6; ++f) {
        const auto& axes = kFaces[f];
        const Imath::V3f across(static_cast<float>(axes[0]), static_cast<float>(axes[1]),
                                static_cast<float>(axes[2]));
        const Imath::V3f along(static_cast<float>(axes[3]), static_cast<float>(axes[4]),
                               static_cast<float>(axes[5]));
        const Imath::V3f outwards = across.cross(along);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t i = 0; i < row * row; ++i) {
            const Imath::V3f place =
                across * uneven(i % row, cells) + along * uneven(i / row, cells) + outwards;
            mesh.positions.push_back(centre + place * half_side);
            mesh.normals.push_back(inwards ? -outwards : outwards);
        }
        for (std::uint32_t i = 0; i < cells * cells; ++i) {
            const std::uint32_t a = first + i / cells * row + i % cells;
            const std::uint32_t b = inwards ? a + row : a + 1;
            const std::uint32_t c = inwards ? a + 1 : a + row;
            const std::uint32_t d = a + row + 1;
            const std::uint32_t material = f % materials;
            mesh.triangles.push_back({{a, b, c}, {0, 1, 2}, material});
            mesh.triangles.push_back({{d, c, b}, {0, 1, 2}, material});
        }
    }
    return mesh;
}

}  // namespace

SurfaceMesh room(std::uint32_t cells, std::uint32_t materials) {
    return cube(cells, materials, {0, 0, 0}, 1, true);
}

SurfaceMesh box(std::uint32_t cells, const Imath::V3f& centre, float half_side) {
    return cube(cells, 1, centre, half_side, false);
}

SurfaceMesh together(SurfaceMesh first, const SurfaceMesh& second) {
    const auto vertices = static_cast<std::uint32_t>(first.positions.size());
    first.positions.insert(first.positions.end(), second.positions.begin(),
                           second.positions.end());
    first.normals.insert(first.normals.end(), second.normals.begin(), second.normals.end());
    for (transport::SurfaceTriangle triangle : second.triangles) {
        for (std::uint32_t& vertex : triangle.vertices) {
            vertex += vertices;
        }
        first.triangles.push_back(triangle);
    }
    return first;
}

}  // namespace relume::test
