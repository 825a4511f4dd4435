// Writes the shared cases of protocol/wire/vectors as seed files: messages and image frames.
// Usage: write_wire_seeds VECTORS MESSAGES IMAGES
#include "protocol/wire/image_header.h"
#include "protocol/wire/messages.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

namespace fs = std::filesystem;
namespace wire = relume::wire;
using nlohmann::json;

json vectors(const fs::path& folder, const std::string& name) {
    std::ifstream file(folder / (name + ".json"));
    return json::parse(file);
}

std::string bytes_from_hex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        unsigned value = 0;
        std::from_chars(hex.data() + i, hex.data() + i + 2, value, 16);
        bytes += static_cast<char>(value);
    }
    return bytes;
}

void write(const fs::path& path, const std::string& content) {
    std::ofstream file(path, std::ios::binary);
    file << content;
    if (!file.flush()) {
        throw std::runtime_error(path.string() + " cannot be written");
    }
}

void write_messages(const fs::path& from, const fs::path& folder) {
    for (const json& c : vectors(from, "patches")) {
        write(folder / c.at("name").get<std::string>(),
              wire::text_from_message(wire::Edit{.id = 1, .patch = c.at("patch")}));
    }
    write(folder / "ack", wire::text_from_message(wire::Ack{.sequence = 42}));
    wire::Snapshot snapshot;
    snapshot.room = "room";
    snapshot.scene = {.name = "scene", .width = 4, .height = 4, .face_resolution = 8};
    write(folder / "snapshot", wire::text_from_message(snapshot));
    write(folder / "viewers", wire::text_from_message(wire::Viewers{.count = 1}));
}

void write_images(const fs::path& from, const fs::path& folder) {
    for (const char* name : {"half_images", "half_images_malformed"}) {
        for (const json& c : vectors(from, name)) {
            const std::string payload = bytes_from_hex(c.at("payload"));
            const auto header = wire::encode_image_header(
                {.encoding = wire::ImageEncoding::half_planes,
                 .width = c.at("width"),
                 .height = c.at("height"),
                 .has_alpha = c.at("has_alpha"),
                 .payload_bytes = static_cast<std::uint32_t>(payload.size())});
            write(folder / c.at("name").get<std::string>(),
                  std::string(reinterpret_cast<const char*>(header.data()), header.size()) +
                      payload);
        }
    }
    for (const json& c : vectors(from, "image_headers_malformed")) {
        write(folder / c.at("name").get<std::string>(),
              bytes_from_hex(c.at("hex")) +
                  std::string(c.at("payload_bytes").get<std::size_t>(), '\0'));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: write_wire_seeds VECTORS MESSAGES IMAGES\n", stderr);
        return 2;
    }
    fs::create_directories(argv[2]);
    fs::create_directories(argv[3]);
    write_messages(argv[1], argv[2]);
    write_images(argv[1], argv[3]);
    return 0;
}
