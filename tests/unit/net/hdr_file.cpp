#include "tests/unit/net/hdr_file.h"

#include "tests/support/scratch_directory.h"

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace relume::net {

void write_hdr(const std::filesystem::path& path, int width, int height, float radiance) {
    const auto output = OIIO::ImageOutput::create(path.string());
    const std::vector<float> pixels(static_cast<std::size_t>(3 * width * height), radiance);
    if (!output || !output->open(path.string(), OIIO::ImageSpec(width, height, 3)) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !output->close()) {
        throw std::runtime_error("cannot write " + path.string());
    }
}

std::string hdr_file(int width, int height) {
    const test::ScratchDirectory folder;
    const std::filesystem::path path = folder.path() / "upload.hdr";
    write_hdr(path, width, height, 0.5F);
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace relume::net
