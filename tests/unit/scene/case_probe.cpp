#include "tests/unit/scene/case_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace relume::test {

std::filesystem::path case_path(const std::string& name) {
    return std::filesystem::path(RELUME_SCENE_CASES) / name;
}

scene::Scene import_case(const std::string& name) {
    return scene::import_scene(case_path(name));
}

Imath::V3f world_position(const scene::Scene& scene, std::size_t mesh, std::size_t vertex) {
    return Imath::V3f(scene.frame.world_from_position(scene.meshes[mesh].positions[vertex]));
}

std::optional<scene::SurfacePoint> surface_at(const scene::Scene& scene, float x, float y) {
    std::optional<scene::SurfacePoint> nearest;
    float highest = -std::numeric_limits<float>::infinity();
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
        const scene::Mesh& mesh = scene.meshes[m];
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto corner = [&](std::size_t k) {
                return world_position(scene, m, mesh.triangles[t][k]);
            };
            const Imath::V3f a = corner(0);
            const Imath::V3f ab = corner(1) - a;
            const Imath::V3f ac = corner(2) - a;
            const float area = ab.x * ac.y - ab.y * ac.x;
            const float u = ((x - a.x) * ac.y - (y - a.y) * ac.x) / area;
            const float v = (ab.x * (y - a.y) - ab.y * (x - a.x)) / area;
            if (!(u >= 0 && v >= 0 && u + v <= 1))
                continue;
            const float z = a.z + ab.z * u + ac.z * v;
            if (z <= highest || !scene::is_solid_at(scene, m, t, {u, v}))
                continue;
            highest = z;
            nearest = scene::surface_point(scene, m, t, {u, v}, {0, 0, -1});
        }
    }
    return nearest;
}

Imath::V3f colour_at(const scene::Scene& scene, float x, float y) {
    const auto point = surface_at(scene, x, y);
    return point ? point->bsdf.diffuse_colour() : Imath::V3f(-1);
}

void expect_quadrants(const scene::Scene& scene) {
    const Imath::V3f red = colour_at(scene, -0.8F, 0.8F);
    const Imath::V3f green = colour_at(scene, 0.8F, 0.8F);
    const Imath::V3f blue = colour_at(scene, -0.8F, -0.8F);
    const Imath::V3f yellow = colour_at(scene, 0.8F, -0.8F);
    EXPECT_TRUE(red.x > 0.4F && red.y < 0.1F && red.z < 0.1F) << red;
    EXPECT_TRUE(green.x < 0.1F && green.y > 0.3F && green.z < 0.1F) << green;
    EXPECT_TRUE(blue.x < 0.1F && blue.y < 0.1F && blue.z > 0.3F) << blue;
    EXPECT_TRUE(yellow.x > 0.3F && yellow.y > 0.3F && yellow.z < 0.1F) << yellow;
}

bool mentions(const std::vector<std::string>& lines, const std::string& word) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(word) != std::string::npos;
    });
}

}  // namespace relume::test
