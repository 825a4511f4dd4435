// Small valid images of many kinds, for image_decode_fuzz to start from.
#include "tests/unit/light/image_files.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

void write_seed(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream.put('\xff');  // no projection asked for
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) {
        throw std::runtime_error("cannot write " + file.string());
    }
}

void write_seeds(const std::filesystem::path& folder) {
    using relume::light::testing::encode;
    std::filesystem::create_directories(folder);
    constexpr int kWidth = 12;
    constexpr int kHeight = 6;
    std::vector<float> values(std::size_t{kWidth} * kHeight * 3);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>(i % 17) * 0.37F;
    }
    write_seed(folder / "rgb.hdr", encode("hdr", kWidth, kHeight, {"R", "G", "B"}, values));
    for (const std::string compression :
         {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "dwaa", "dwab"}) {
        for (const bool tiled : {false, true}) {
            const auto adjust = [&](OIIO::ImageSpec& spec) {
                spec["compression"] = compression;
                spec.tile_width = tiled ? 4 : 0;
                spec.tile_height = tiled ? 4 : 0;
                spec.set_format(tiled ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
            };
            write_seed(folder / (compression + (tiled ? "-tiled.exr" : ".exr")),
                       encode("openexr", kWidth, kHeight, {"R", "G", "B"}, values, adjust));
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: write_image_seeds FOLDER\n");
        return 2;
    }
    try {
        write_seeds(argv[1]);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "write_image_seeds: %s\n", e.what());
        return 1;
    }
    return 0;
}
