#include "precompute/scene/gltf/triangles.h"

#include <tiny_gltf.h>

#include <algorithm>

namespace relume::scene::gltf {

std::vector<Triangle> triangles_of(int mode, const std::vector<std::uint32_t>& corners) {
    std::vector<Triangle> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(corners.size() / 3);
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
        else
            triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
    }
    return triangles;
}

std::vector<std::uint32_t> take_used_vertices(std::vector<Triangle>& triangles,
                                              std::size_t count) {
    std::vector<std::uint32_t> used;
    // A table is fast, but may be much longer than all the triangles.
    if (count <= 16 * triangles.size()) {
        constexpr std::uint32_t kUnused = ~std::uint32_t{0};
        std::vector<std::uint32_t> place(count, kUnused);
        for (const Triangle& triangle : triangles) {
            for (const std::uint32_t corner : triangle)
                place[corner] = 0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (place[i] == kUnused)
                continue;
            place[i] = static_cast<std::uint32_t>(used.size());
            used.push_back(static_cast<std::uint32_t>(i));
        }
        for (Triangle& triangle : triangles) {
            for (std::uint32_t& corner : triangle)
                corner = place[corner];
        }
        return used;
    }
    for (const Triangle& triangle : triangles)
        used.insert(used.end(), triangle.begin(), triangle.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (Triangle& triangle : triangles) {
        for (std::uint32_t& corner : triangle)
            corner = static_cast<std::uint32_t>(
                std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    }
    return used;
}

}  // namespace relume::scene::gltf
