#include "precompute/scene/builtin/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace relume::scene {
namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

float fraction(std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(whole);
}

}  // namespace

Imath::M44f placed(const Imath::V3f& position, float degrees_around_y) {
    Imath::M44f matrix;
    matrix.setEulerAngles(Imath::V3f(0, degrees_around_y * kTwoPi / 360.0F, 0));
    matrix[3][0] = position.x;
    matrix[3][1] = position.y;
    matrix[3][2] = position.z;
    return matrix;
}

MeshBuilder::MeshBuilder(std::string name, std::uint32_t material) {
    mesh_.name = std::move(name);
    mesh_.material = material;
}

Mesh MeshBuilder::take() {
    return std::exchange(mesh_, Mesh{});
}

std::uint32_t MeshBuilder::add_vertex(const Imath::V3f& position,
                                      const Imath::V3f& normal,
                                      const Imath::V2f& uv) {
    Imath::V3f turned;
    to_world_.multDirMatrix(normal, turned);
    mesh_.positions.push_back(position * to_world_);
    mesh_.normals.push_back(turned);
    mesh_.uvs.push_back(uv);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::add_flat_quad(const Imath::V3f& p0,
                                const Imath::V3f& p1,
                                const Imath::V3f& p2,
                                const Imath::V3f& p3,
                                const Imath::V2f& uv_size) {
    const Imath::V3f normal = (p2 - p0).cross(p3 - p1).normalized();
    const std::uint32_t first = add_vertex(p0, normal, {0, 0});
    add_vertex(p1, normal, {uv_size.x, 0});
    add_vertex(p2, normal, uv_size);
    add_vertex(p3, normal, {0, uv_size.y});
    mesh_.triangles.push_back({first, first + 1, first + 2});
    mesh_.triangles.push_back({first, first + 2, first + 3});
}

void MeshBuilder::add_quad(const Imath::V3f& p0,
                           const Imath::V3f& p1,
                           const Imath::V3f& p2,
                           const Imath::V3f& p3) {
    add_flat_quad(p0, p1, p2, p3, {1, 1});
}

void MeshBuilder::add_bar(const Imath::V3f (&c)[8]) {
    // Corners 0-3 are the bottom, 4-7 the top, both counter-clockwise seen from above.
    constexpr std::size_t kSides[6][4] = {{0, 1, 2, 3}, {7, 6, 5, 4}, {4, 5, 1, 0},
                                          {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}};
    for (const auto& side : kSides) {
        const Imath::V3f& p0 = c[side[3]];
        const Imath::V3f& p1 = c[side[2]];
        const Imath::V3f& p2 = c[side[1]];
        const Imath::V3f& p3 = c[side[0]];
        const float width = (p1 - p0).length();
        const float height = (p3 - p0).length();
        if (width >= height)
            add_flat_quad(p0, p1, p2, p3, {width, height});
        else
            add_flat_quad(p1, p2, p3, p0, {height, width});
    }
}

void MeshBuilder::add_box(const Imath::V3f& centre, const Imath::V3f& size) {
    const Imath::V3f half_up(0, size.y * 0.5F, 0);
    add_tapered_bar(centre - half_up, {size.x, size.z}, centre + half_up, {size.x, size.z});
}

void MeshBuilder::add_tapered_bar(const Imath::V3f& bottom,
                                  const Imath::V2f& bottom_size,
                                  const Imath::V3f& top,
                                  const Imath::V2f& top_size) {
    Imath::V3f corners[8];
    constexpr float kX[4] = {-0.5F, -0.5F, 0.5F, 0.5F};
    constexpr float kZ[4] = {-0.5F, 0.5F, 0.5F, -0.5F};
    for (std::size_t i = 0; i < 4; ++i) {
        corners[i] = bottom + Imath::V3f(kX[i] * bottom_size.x, 0, kZ[i] * bottom_size.y);
        corners[i + 4] = top + Imath::V3f(kX[i] * top_size.x, 0, kZ[i] * top_size.y);
    }
    add_bar(corners);
}

void MeshBuilder::add_grid(
    std::uint32_t rows,
    std::uint32_t columns,
    Closing along_rows,
    Closing along_columns,
    const std::function<Imath::V3f(std::uint32_t, std::uint32_t)>& position) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    std::vector<Imath::V3f> points;
    points.reserve(std::size_t{rows} * columns);
    for (std::uint32_t i = 0; i < rows; ++i) {
        for (std::uint32_t j = 0; j < columns; ++j)
            points.push_back(position(i, j));
    }
    std::vector<Imath::V3f> normals(points.size(), Imath::V3f(0, 0, 0));
    const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Imath::V3f cross = (points[b] - points[a]).cross(points[c] - points[a]);
        if (points[a] == points[b] || points[b] == points[c] || points[c] == points[a])
            return;  // at a pole
        normals[a] += cross;
        normals[b] += cross;
        normals[c] += cross;
        mesh_.triangles.push_back({first + a, first + b, first + c});
    };
    const std::uint32_t row_cells = along_rows == Closing::closed ? rows : rows - 1;
    const std::uint32_t column_cells = along_columns == Closing::closed ? columns : columns - 1;
    for (std::uint32_t i = 0; i < row_cells; ++i) {
        for (std::uint32_t j = 0; j < column_cells; ++j) {
            const std::uint32_t i1 = (i + 1) % rows;
            const std::uint32_t j1 = (j + 1) % columns;
            add_triangle(i * columns + j, i1 * columns + j1, i1 * columns + j);
            add_triangle(i * columns + j, i * columns + j1, i1 * columns + j1);
        }
    }
    for (std::uint32_t i = 0; i < rows; ++i) {
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::size_t index = std::size_t{i} * columns + j;
            const Imath::V3f& normal = normals[index];
            // A pole's points share the pole: those left without a face take the axis.
            add_vertex(points[index],
                       normal.length() > 0 ? normal.normalized() : Imath::V3f(0, 1, 0),
                       {fraction(j, column_cells), fraction(i, row_cells)});
        }
    }
}

void MeshBuilder::add_tube(const std::vector<TubePoint>& axis,
                           std::uint32_t sides,
                           Closing ends) {
    const auto rows = static_cast<std::uint32_t>(axis.size());
    // Parallel transport keeps the rings from twisting.
    std::vector<Imath::V3f> across(rows);
    std::vector<Imath::V3f> along(rows);
    for (std::uint32_t i = 0; i < rows; ++i) {
        const std::uint32_t before = i == 0 ? 0 : i - 1;
        const std::uint32_t after = std::min(i + 1, rows - 1);
        along[i] = (axis[after].centre - axis[before].centre).normalized();
        Imath::V3f reference = i == 0 ? Imath::V3f(1, 0, 0) : across[i - 1];
        if (std::abs(reference.dot(along[i])) > 0.9F)
            reference = Imath::V3f(0, 0, 1);
        across[i] = (reference - along[i] * reference.dot(along[i])).normalized();
    }
    const auto ring_point = [&](std::uint32_t i, std::uint32_t j) {
        const float phi = kTwoPi * fraction(j, sides);
        const Imath::V3f side = along[i].cross(across[i]);
        return axis[i].centre +
               (across[i] * std::cos(phi) + side * std::sin(phi)) * axis[i].radius;
    };
    add_grid(rows, sides, Closing::open, Closing::closed, ring_point);
    if (ends == Closing::open)
        return;
    for (const std::uint32_t end : {std::uint32_t{0}, rows - 1}) {
        const Imath::V3f normal = end == 0 ? -along[end] : along[end];
        const std::uint32_t centre = add_vertex(axis[end].centre, normal, {0, 0});
        for (std::uint32_t j = 0; j < sides; ++j)
            add_vertex(ring_point(end, j), normal, {0, 0});
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t next = (j + 1) % sides;
            const std::uint32_t a = centre + 1 + (end == 0 ? next : j);
            const std::uint32_t b = centre + 1 + (end == 0 ? j : next);
            mesh_.triangles.push_back({centre, a, b});
        }
    }
}

void MeshBuilder::add_lathe(const std::vector<ProfilePoint>& outline, std::uint32_t segments) {
    add_grid(static_cast<std::uint32_t>(outline.size()), segments, Closing::open,
             Closing::closed, [&](std::uint32_t i, std::uint32_t j) {
                 const float phi = kTwoPi * fraction(j, segments);
                 const auto& [radius, height] = outline[i];
                 return radius == 0 ? Imath::V3f(0, height, 0)
                                    : Imath::V3f(radius * std::cos(phi), height,
                                                 -radius * std::sin(phi));
             });
}

void MeshBuilder::add_sphere(const Imath::V3f& centre, float radius, std::uint32_t segments) {
    const std::uint32_t rows = segments / 2 + 1;
    add_grid(
        rows, segments, Closing::open, Closing::closed, [&](std::uint32_t i, std::uint32_t j) {
            const float theta = std::numbers::pi_v<float> * fraction(i, rows - 1);
            const float phi = kTwoPi * fraction(j, segments);
            const float ring = i == 0 || i == rows - 1 ? 0.0F : std::sin(theta);
            return centre +
                   Imath::V3f(ring * std::cos(phi), -std::cos(theta), -ring * std::sin(phi)) *
                       radius;
        });
}

void MeshBuilder::add_mesh(const Mesh& mesh, const Imath::V3f& offset) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        add_vertex(mesh.positions[i] + offset, mesh.normals[i], mesh.uvs[i]);
    for (const auto& [a, b, c] : mesh.triangles)
        mesh_.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace relume::scene
