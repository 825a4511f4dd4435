#include "precompute/scene/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// The directions of growing u and v over a triangle; zero where its coordinates span none.
struct TextureAxes {
    Imath::V3d u{0, 0, 0};
    Imath::V3d v{0, 0, 0};
};

TextureAxes texture_axes(const Mesh& mesh,
                         std::span<const Imath::V2f> uvs,
                         const Triangle& triangle) {
    const Imath::V2d uv0(uvs[triangle[0]]);
    const Imath::V2d duv1 = Imath::V2d(uvs[triangle[1]]) - uv0;
    const Imath::V2d duv2 = Imath::V2d(uvs[triangle[2]]) - uv0;
    const double determinant = duv1.x * duv2.y - duv1.y * duv2.x;
    if (determinant == 0 || !std::isfinite(determinant))
        return {};
    const Imath::V3d p0(mesh.positions[triangle[0]]);
    const Imath::V3d e1 = Imath::V3d(mesh.positions[triangle[1]]) - p0;
    const Imath::V3d e2 = Imath::V3d(mesh.positions[triangle[2]]) - p0;
    return {.u = (e1 * duv2.y - e2 * duv1.y) / determinant,
            .v = (e2 * duv1.x - e1 * duv2.x) / determinant};
}

Imath::V3d across(const Imath::V3d& direction, const Imath::V3d& normal) {
    return (direction - normal * normal.dot(direction)).normalized();
}

double side_of(const TextureAxes& axes, const Imath::V3d& normal) {
    return normal.cross(axes.u).dot(axes.v) < 0 ? -1.0 : 1.0;
}

template <typename Value>
void take(std::vector<Value>& values, const std::vector<std::uint32_t>& from) {
    if (values.empty())
        return;
    std::vector<Value> taken;
    taken.reserve(from.size());
    for (const std::uint32_t vertex : from)
        taken.push_back(values[vertex]);
    values = std::move(taken);
}

// Vertex i of the mesh becomes what vertex from[i] was.
void rearrange(Mesh& mesh, const std::vector<std::uint32_t>& from) {
    take(mesh.positions, from);
    take(mesh.normals, from);
    take(mesh.uvs, from);
    for (std::vector<Imath::V2f>& set : mesh.more_uvs)
        take(set, from);
    take(mesh.colours, from);
    take(mesh.opacities, from);
}

void add_flat_tangents(Mesh& mesh, std::size_t uv_set) {
    std::vector<std::uint32_t> from;
    from.reserve(3 * mesh.triangles.size());
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle)
            from.push_back(std::exchange(corner, static_cast<std::uint32_t>(from.size())));
    }
    rearrange(mesh, from);
    mesh.tangents.assign(from.size(), Imath::V4f(0, 0, 0, 1));
    for (const Triangle& triangle : mesh.triangles) {
        const Imath::V3d p0(mesh.positions[triangle[0]]);
        const Imath::V3d normal = (Imath::V3d(mesh.positions[triangle[1]]) - p0)
                                      .cross(Imath::V3d(mesh.positions[triangle[2]]) - p0)
                                      .normalized();
        const TextureAxes axes = texture_axes(mesh, mesh.uv_set(uv_set), triangle);
        const Imath::V3f tangent(across(axes.u, normal));
        const auto side = static_cast<float>(side_of(axes, normal));
        for (const std::uint32_t corner : triangle)
            mesh.tangents[corner] = {tangent.x, tangent.y, tangent.z, side};
    }
}

// For each vertex, the first one of the same position, normal and texture coordinates.
std::vector<std::uint32_t> first_alike(const Mesh& mesh, std::span<const Imath::V2f> uvs) {
    using Key = std::array<float, 8>;
    const auto key = [&](std::uint32_t i) {
        const Imath::V3f& p = mesh.positions[i];
        const Imath::V3f& n = mesh.normals[i];
        return Key{p.x, p.y, p.z, n.x, n.y, n.z, uvs[i].x, uvs[i].y};
    };
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Key of_a = key(a);
        const Key of_b = key(b);
        return of_a != of_b ? of_a < of_b : a < b;
    });
    std::vector<std::uint32_t> first(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_new = i == 0 || key(order[i]) != key(order[i - 1]);
        first[order[i]] = is_new ? order[i] : first[order[i - 1]];
    }
    return first;
}

double angle_at(const Mesh& mesh, const Triangle& triangle, std::size_t corner) {
    const Imath::V3d p(mesh.positions[triangle[corner]]);
    const Imath::V3d a =
        (Imath::V3d(mesh.positions[triangle[(corner + 1) % 3]]) - p).normalized();
    const Imath::V3d b =
        (Imath::V3d(mesh.positions[triangle[(corner + 2) % 3]]) - p).normalized();
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

void add_smooth_tangents(Mesh& mesh, std::size_t uv_set) {
    const auto uvs = mesh.uv_set(uv_set);
    const std::vector<std::uint32_t> first = first_alike(mesh, uvs);
    const std::size_t count = mesh.positions.size();
    // Sums of the mirrored triangles stand `count` after those of the others.
    std::vector<Imath::V3d> sums(2 * count, Imath::V3d(0, 0, 0));
    std::vector<std::array<std::uint32_t, 3>> slots(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        const TextureAxes axes = texture_axes(mesh, uvs, triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            const Imath::V3d normal(mesh.normals[triangle[k]]);
            const std::size_t mirrored = side_of(axes, normal) < 0 ? count : 0;
            const std::size_t slot = first[triangle[k]] + mirrored;
            slots[t][k] = static_cast<std::uint32_t>(slot);
            sums[slot] += across(axes.u, normal) * angle_at(mesh, triangle, k);
        }
    }
    std::vector<std::uint32_t> from(count);
    std::iota(from.begin(), from.end(), 0U);
    std::vector<std::uint32_t> slot_of(count, kNone);
    std::vector<std::uint32_t> twin(count, kNone);  // of the other side
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& corner = mesh.triangles[t][k];
            const std::uint32_t slot = slots[t][k];
            if (slot_of[corner] == kNone)
                slot_of[corner] = slot;
            if (slot_of[corner] == slot)
                continue;
            if (twin[corner] == kNone) {
                twin[corner] = static_cast<std::uint32_t>(from.size());
                from.push_back(corner);
                slot_of.push_back(slot);
            }
            corner = twin[corner];
        }
    }
    rearrange(mesh, from);
    mesh.tangents.assign(from.size(), Imath::V4f(0, 0, 0, 1));
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (slot_of[i] == kNone)
            continue;
        const Imath::V3f tangent(sums[slot_of[i]].normalized());
        const float side = slot_of[i] >= count ? -1.0F : 1.0F;
        mesh.tangents[i] = {tangent.x, tangent.y, tangent.z, side};
    }
}

}  // namespace

void add_tangents(Mesh& mesh, std::size_t uv_set) {
    if (mesh.uv_set(uv_set).empty()) {
        mesh.tangents.clear();
    } else if (mesh.normals.empty()) {
        add_flat_tangents(mesh, uv_set);
    } else {
        add_smooth_tangents(mesh, uv_set);
    }
}

}  // namespace relume::scene
