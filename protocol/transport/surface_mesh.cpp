#include "protocol/transport/surface_mesh.h"

#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace relume::transport {
namespace {

static_assert(sizeof(Imath::V3f) == 3 * sizeof(float));
static_assert(sizeof(Imath::V2f) == 2 * sizeof(float));
static_assert(sizeof(SurfaceTriangle) == 7 * sizeof(std::uint32_t));

struct Counts {
    std::uint32_t vertices = 0;
    std::uint32_t uvs = 0;
    std::uint32_t triangles = 0;
    std::uint32_t zero = 0;
};

[[noreturn]] void fail(std::string_view file,
                       const std::string& where,
                       const std::string& found,
                       const std::string& expected) {
    throw TransportError(
        fmt::format("{}: {}: found {}, expected {}", file, where, found, expected));
}

std::uint64_t file_bytes_from(const Counts& counts) {
    return sizeof(Counts) + std::uint64_t{counts.vertices} * 2 * sizeof(Imath::V3f) +
           std::uint64_t{counts.uvs} * sizeof(Imath::V2f) +
           std::uint64_t{counts.triangles} * sizeof(SurfaceTriangle);
}

bool is_finite(const Imath::V3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string text(const Imath::V3f& v) {
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

void check_counts(const SurfaceMesh& mesh, std::string_view file) {
    const auto require = [&](const char* what, std::size_t found) {
        if (found < 1 || found > std::numeric_limits<std::uint32_t>::max()) {
            fail(file, fmt::format("count of {}", what), fmt::format("{}", found),
                 "a number from 1 to 2^32 - 1");
        }
    };
    require("vertices", mesh.positions.size());
    require("texture coordinates", mesh.uvs.size());
    require("triangles", mesh.triangles.size());
    if (mesh.normals.size() != mesh.positions.size()) {
        fail(file, "count of normals", fmt::format("{}", mesh.normals.size()),
             fmt::format("{}, one for each vertex", mesh.positions.size()));
    }
}

void check_triangle(const SurfaceMesh& mesh, std::size_t triangle, std::string_view file) {
    const auto& [vertices, uvs, material] = mesh.triangles[triangle];
    const auto require = [&](bool holds, const char* what, std::uint32_t found,
                             const std::string& expected) {
        if (!holds) {
            fail(file, fmt::format("triangle {}: {}", triangle, what), fmt::format("{}", found),
                 expected);
        }
    };
    for (const std::uint32_t vertex : vertices) {
        require(vertex < mesh.positions.size(), "vertex", vertex,
                fmt::format("one of {}", mesh.positions.size()));
    }
    for (const std::uint32_t uv : uvs) {
        require(uv < mesh.uvs.size(), "texture coordinates", uv,
                fmt::format("one of {}", mesh.uvs.size()));
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        require(vertices[i] != vertices[(i + 1) % vertices.size()], "vertex", vertices[i],
                "three different ones");
    }
}

// Takes arrays off the front of the bytes, which are as long as the counts say.
class ArrayReader {
  public:
    explicit ArrayReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <typename T>
    std::vector<T> take(std::size_t count) {
        std::vector<T> values(count);
        if (count > 0) {
            std::memcpy(static_cast<void*>(values.data()), bytes_.data(), count * sizeof(T));
        }
        bytes_ = bytes_.subspan(count * sizeof(T));
        return values;
    }

  private:
    std::span<const std::byte> bytes_;
};

template <typename T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
    const auto added = std::as_bytes(values);
    bytes.insert(bytes.end(), added.begin(), added.end());
}

}  // namespace

void check_surface_mesh(const SurfaceMesh& mesh, std::string_view file) {
    check_counts(mesh, file);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!is_finite(mesh.positions[i])) {
            fail(file, fmt::format("position of vertex {}", i), text(mesh.positions[i]),
                 "finite numbers");
        }
        if (!(std::abs(mesh.normals[i].length() - 1) <= kSurfaceNormalTolerance)) {
            fail(file, fmt::format("normal of vertex {}", i), text(mesh.normals[i]),
                 "a unit vector");
        }
    }
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        if (!std::isfinite(mesh.uvs[i].x) || !std::isfinite(mesh.uvs[i].y)) {
            fail(file, fmt::format("texture coordinates {}", i),
                 fmt::format("({}, {})", mesh.uvs[i].x, mesh.uvs[i].y), "finite numbers");
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        check_triangle(mesh, i, file);
    }
}

std::vector<std::byte> bytes_from_surface_mesh(const SurfaceMesh& mesh) {
    const Counts counts{.vertices = static_cast<std::uint32_t>(mesh.positions.size()),
                        .uvs = static_cast<std::uint32_t>(mesh.uvs.size()),
                        .triangles = static_cast<std::uint32_t>(mesh.triangles.size())};
    std::vector<std::byte> bytes;
    bytes.reserve(file_bytes_from(counts));
    append(bytes, std::span(&counts, 1));
    append(bytes, std::span(mesh.positions));
    append(bytes, std::span(mesh.normals));
    append(bytes, std::span(mesh.uvs));
    append(bytes, std::span(mesh.triangles));
    return bytes;
}

SurfaceMesh surface_mesh_from_bytes(std::span<const std::byte> bytes, std::string_view file) {
    Counts counts;
    if (bytes.size() < sizeof(counts)) {
        fail(file, "length", fmt::format("{} bytes", bytes.size()),
             fmt::format("at least {}", sizeof(counts)));
    }
    std::memcpy(&counts, bytes.data(), sizeof(counts));
    if (counts.zero != 0) {
        fail(file, "reserved part", fmt::format("{}", counts.zero), "zero");
    }
    if (const std::uint64_t expected = file_bytes_from(counts); bytes.size() != expected) {
        fail(file, "length", fmt::format("{} bytes", bytes.size()),
             fmt::format("{} for {} vertices, {} texture coordinates and {} triangles",
                         expected, counts.vertices, counts.uvs, counts.triangles));
    }
    ArrayReader reader(bytes.subspan(sizeof(counts)));
    SurfaceMesh mesh;
    mesh.positions = reader.take<Imath::V3f>(counts.vertices);
    mesh.normals = reader.take<Imath::V3f>(counts.vertices);
    mesh.uvs = reader.take<Imath::V2f>(counts.uvs);
    mesh.triangles = reader.take<SurfaceTriangle>(counts.triangles);
    check_surface_mesh(mesh, file);
    return mesh;
}

void check_surface_materials(const SurfaceMesh& mesh,
                             std::span<const std::uint32_t> material_from_vertex,
                             std::string_view file) {
    if (material_from_vertex.size() != mesh.vertex_count()) {
        fail(file, "count of vertices", fmt::format("{}", mesh.vertex_count()),
             fmt::format("{} as the clusters have", material_from_vertex.size()));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const SurfaceTriangle& triangle = mesh.triangles[i];
        for (const std::uint32_t vertex : triangle.vertices) {
            if (material_from_vertex[vertex] != triangle.material) {
                fail(file, fmt::format("triangle {}: material", i),
                     fmt::format("{}", triangle.material),
                     fmt::format("{}, that of the cluster of its vertex {}",
                                 material_from_vertex[vertex], vertex));
            }
        }
    }
}

}  // namespace relume::transport
