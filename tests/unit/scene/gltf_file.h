// glTF documents for tests: complete, with the buffer inside, to be changed before writing.
#pragma once

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relume::test {

[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

// One node `thing` with one mesh of one material (default), and one node `eye` with a
// perspective camera of 40° at (0, 0, 5), looking to −Z.
[[nodiscard]] nlohmann::json gltf_document(const std::vector<Imath::V3f>& positions,
                                           const std::vector<std::uint16_t>& indices,
                                           const std::vector<Imath::V2f>& uvs = {});
// A unit triangle in z = 0.
[[nodiscard]] nlohmann::json gltf_triangle();
// The triangle as a binary file, its buffer as the second chunk.
[[nodiscard]] std::string glb_triangle();

void write_text(const std::filesystem::path& path, const std::string& text);
void write_json(const std::filesystem::path& path, const nlohmann::json& document);
// A 2×1 picture, red left, green right (display-referred, full).
void write_red_green(const std::filesystem::path& path);
[[nodiscard]] std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

}  // namespace relume::test
