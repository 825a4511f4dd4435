// mesh.bin: what is written is read, and nothing else is taken.
#include "protocol/transport/surface_mesh.h"

#include "protocol/transport/error.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace relume::transport {
namespace {

// Two triangles of one square, and one of another material at its edge.
SurfaceMesh small_mesh() {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    mesh.normals = {{0, 0, 1},  {0, 0, 1},  {0, 0, 1}, {0, 0, 1},
                    {0, -1, 0}, {0, -1, 0}, {0, -1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{.vertices = {0, 1, 2}, .uvs = {0, 1, 2}, .material = 0},
                      {.vertices = {0, 2, 3}, .uvs = {0, 2, 3}, .material = 0},
                      {.vertices = {4, 5, 6}, .uvs = {0, 0, 0}, .material = 1}};
    return mesh;
}

std::string refusal(std::span<const std::byte> bytes) {
    try {
        [[maybe_unused]] const SurfaceMesh mesh = surface_mesh_from_bytes(bytes, "mesh.bin");
        return "";
    } catch (const TransportError& error) {
        return error.what();
    }
}

std::string refusal(const SurfaceMesh& mesh) {
    return refusal(bytes_from_surface_mesh(mesh));
}

void expect_named(const std::string& message, const std::string& part) {
    EXPECT_EQ(message.rfind("mesh.bin: ", 0), 0U) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(SurfaceMesh, WhatIsWrittenIsRead) {
    const SurfaceMesh mesh = small_mesh();
    EXPECT_EQ(surface_mesh_from_bytes(bytes_from_surface_mesh(mesh), "mesh.bin"), mesh);
}

TEST(SurfaceMesh, BytesAreThoseOfTheSpecification) {
    SurfaceMesh mesh;
    mesh.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}};
    mesh.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    mesh.uvs = {{0.25F, 0.5F}};
    mesh.triangles = {{.vertices = {2, 0, 1}, .uvs = {0, 0, 0}, .material = 9}};
    const auto bytes = bytes_from_surface_mesh(mesh);
    const std::uint32_t integers[] = {3, 1, 1, 0};
    const float floats[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0.25F, 0.5F};
    const std::uint32_t triangle[] = {2, 0, 1, 0, 0, 0, 9};
    ASSERT_EQ(bytes.size(), sizeof(integers) + sizeof(floats) + sizeof(triangle));
    EXPECT_EQ(std::memcmp(bytes.data(), integers, sizeof(integers)), 0);
    EXPECT_EQ(std::memcmp(bytes.data() + sizeof(integers), floats, sizeof(floats)), 0);
    EXPECT_EQ(std::memcmp(bytes.data() + sizeof(integers) + sizeof(floats), triangle,
                          sizeof(triangle)),
              0);
}

TEST(SurfaceMesh, AnotherLengthIsRefused) {
    auto bytes = bytes_from_surface_mesh(small_mesh());
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{15}, std::size_t{16}, bytes.size() - 1}) {
        expect_named(refusal(std::span(bytes).first(size)), "length");
    }
    bytes.push_back(std::byte{0});
    expect_named(refusal(bytes), "length");
}

// Counts whose arrays would take 200 GB are refused by the file's length, not by the allocator.
TEST(SurfaceMesh, CountsBeyondTheFileAreRefused) {
    auto bytes = bytes_from_surface_mesh(small_mesh());
    for (std::size_t i = 0; i < 12; ++i) {
        bytes[i] = std::byte{0xff};
    }
    expect_named(refusal(bytes), "4294967295 vertices");
}

TEST(SurfaceMesh, ReservedPartIsZero) {
    auto bytes = bytes_from_surface_mesh(small_mesh());
    bytes[13] = std::byte{1};
    expect_named(refusal(bytes), "reserved");
}

TEST(SurfaceMesh, NothingIsRefused) {
    expect_named(refusal(SurfaceMesh{}), "count of vertices: found 0");
    SurfaceMesh mesh = small_mesh();
    mesh.triangles.clear();
    expect_named(refusal(mesh), "count of triangles: found 0");
    mesh = small_mesh();
    mesh.uvs.clear();
    expect_named(refusal(mesh), "count of texture coordinates: found 0");
}

TEST(SurfaceMesh, NumbersAreFiniteAndNormalsUnit) {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity()};
    for (const float value : bad) {
        SurfaceMesh mesh = small_mesh();
        mesh.positions[3].y = value;
        expect_named(refusal(mesh), "position of vertex 3");
        mesh = small_mesh();
        mesh.normals[2].x = value;
        expect_named(refusal(mesh), "normal of vertex 2");
        mesh = small_mesh();
        mesh.uvs[1].x = value;
        expect_named(refusal(mesh), "texture coordinates 1");
    }
    SurfaceMesh mesh = small_mesh();
    mesh.normals[0] = {0, 0, 1.01F};
    expect_named(refusal(mesh), "normal of vertex 0");
    mesh.normals[0] = {0, 0, 0};
    expect_named(refusal(mesh), "normal of vertex 0");
}

TEST(SurfaceMesh, IndicesAreInRange) {
    SurfaceMesh mesh = small_mesh();
    mesh.triangles[1].vertices[2] = 7;
    expect_named(refusal(mesh), "triangle 1: vertex: found 7, expected one of 7");
    mesh = small_mesh();
    mesh.triangles[2].uvs[0] = 4;
    expect_named(refusal(mesh), "triangle 2: texture coordinates: found 4");
}

TEST(SurfaceMesh, ATriangleHasThreeVertices) {
    for (std::size_t at = 0; at < 3; ++at) {
        SurfaceMesh mesh = small_mesh();
        auto& vertices = mesh.triangles[0].vertices;
        vertices[at] = vertices[(at + 1) % 3];
        expect_named(refusal(mesh), "triangle 0: vertex");
    }
}

TEST(SurfaceMesh, ATriangleIsOfItsVerticesMaterial) {
    const SurfaceMesh mesh = small_mesh();
    const auto check = [&](const std::vector<std::uint32_t>& materials) -> std::string {
        try {
            check_surface_materials(mesh, materials, "mesh.bin");
            return "";
        } catch (const TransportError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(check({0, 0, 0, 0, 1, 1, 1}), "");
    expect_named(check({0, 0, 0, 0, 1, 0, 1}), "triangle 2: material: found 1, expected 0");
    expect_named(check({0, 0, 0, 0, 1, 1}), "count of vertices: found 7, expected 6");
}

}  // namespace
}  // namespace relume::transport
