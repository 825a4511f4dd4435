#include "tests/unit/scene/gltf_file.h"

#include <OpenImageIO/imageio.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace relume::test {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text.push_back(k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=');
    }
    return text;
}

namespace {

// The document without its buffer's content, which goes to `buffer`.
nlohmann::json document_over(const std::vector<Imath::V3f>& positions,
                             const std::vector<std::uint16_t>& indices,
                             const std::vector<Imath::V2f>& uvs,
                             std::vector<std::uint8_t>& buffer) {
    nlohmann::json views = nlohmann::json::array();
    const auto append = [&](const void* data, std::size_t bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        views.push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes}});
        const auto* begin = static_cast<const std::uint8_t*>(data);
        buffer.insert(buffer.end(), begin, begin + bytes);
    };
    append(positions.data(), positions.size() * sizeof(Imath::V3f));
    append(indices.data(), indices.size() * sizeof(std::uint16_t));
    nlohmann::json accessors = {{{"bufferView", 0},
                                 {"componentType", 5126},
                                 {"count", positions.size()},
                                 {"type", "VEC3"}},
                                {{"bufferView", 1},
                                 {"componentType", 5123},
                                 {"count", indices.size()},
                                 {"type", "SCALAR"}}};
    nlohmann::json attributes = {{"POSITION", 0}};
    if (!uvs.empty()) {
        append(uvs.data(), uvs.size() * sizeof(Imath::V2f));
        accessors.push_back({{"bufferView", 2},
                             {"componentType", 5126},
                             {"count", uvs.size()},
                             {"type", "VEC2"}});
        attributes["TEXCOORD_0"] = 2;
    }
    return {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes",
         {{{"name", "thing"}, {"mesh", 0}},
          {{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 5}}}}},
        {"meshes",
         {{{"name", "shape"},
           {"primitives", {{{"attributes", attributes}, {"indices", 1}, {"material", 0}}}}}}},
        {"materials",
         {{{"name", "stuff"}, {"pbrMetallicRoughness", nlohmann::json::object()}}}},
        {"cameras",
         {{{"type", "perspective"},
           {"perspective",
            {{"yfov", 40.0 * 3.14159265358979 / 180.0},
             {"aspectRatio", 1.5},
             {"znear", 0.1}}}}}},
        {"buffers", {{{"byteLength", buffer.size()}}}},
        {"bufferViews", views},
        {"accessors", accessors},
    };
}

std::string little_endian(std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    return {static_cast<char>(v & 255U), static_cast<char>(v >> 8U & 255U),
            static_cast<char>(v >> 16U & 255U), static_cast<char>(v >> 24U)};
}

const std::vector<Imath::V3f> kPositions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<std::uint16_t> kIndices{0, 1, 2};
const std::vector<Imath::V2f> kUvs{{0, 0}, {1, 0}, {0, 1}};

}  // namespace

nlohmann::json gltf_document(const std::vector<Imath::V3f>& positions,
                             const std::vector<std::uint16_t>& indices,
                             const std::vector<Imath::V2f>& uvs) {
    std::vector<std::uint8_t> buffer;
    nlohmann::json document = document_over(positions, indices, uvs, buffer);
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer);
    return document;
}

nlohmann::json gltf_triangle() {
    return gltf_document(kPositions, kIndices, kUvs);
}

std::string glb_triangle() {
    std::vector<std::uint8_t> buffer;
    std::string text = document_over(kPositions, kIndices, kUvs, buffer).dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    buffer.resize((buffer.size() + 3) / 4 * 4);
    const std::string chunks = little_endian(text.size()) + "JSON" + text +
                               little_endian(buffer.size()) + std::string("BIN\0", 4) +
                               std::string(buffer.begin(), buffer.end());
    return "glTF" + little_endian(2) + little_endian(12 + chunks.size()) + chunks;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

void write_json(const std::filesystem::path& path, const nlohmann::json& document) {
    write_text(path, document.dump());
}

void write_red_green(const std::filesystem::path& path) {
    const std::uint8_t pixels[] = {255, 0, 0, 0, 255, 0};
    const auto output = OIIO::ImageOutput::create(path.string());
    const OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::UINT8);
    if (!output || !output->open(path.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels) || !output->close())
        throw std::runtime_error("cannot write " + path.string());
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace relume::test
