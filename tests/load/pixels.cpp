#include "tests/load/pixels.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <stdexcept>

namespace relume::test {

namespace fs = std::filesystem;

Pixels pixels_of(const fs::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) {
        throw std::runtime_error(OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    Pixels pixels{.channels = spec.nchannels, .values = {}};
    pixels.values.resize(static_cast<std::size_t>(spec.image_pixels()) *
                         static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.values.data())) {
        throw std::runtime_error(input->geterror());
    }
    return pixels;
}

double relative_l2(const Pixels& a, const Pixels& b, double scale) {
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double expected = scale * a.values[i];
        difference += (b.values[i] - expected) * (b.values[i] - expected);
        size += expected * expected;
    }
    return std::sqrt(difference / size);
}

void write_environment(const fs::path& path) {
    constexpr int kWidth = 64;
    constexpr int kHeight = 32;
    std::vector<float> texels(std::size_t{3} * kWidth * kHeight, 0.25F);
    for (std::size_t c = 0; c < 3; ++c) {
        texels[(std::size_t{8} * kWidth + 20) * 3 + c] = 400.0F;
    }
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output ||
        !output->open(path.string(),
                      OIIO::ImageSpec(kWidth, kHeight, 3, OIIO::TypeDesc::FLOAT)) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, texels.data()) || !output->close()) {
        throw std::runtime_error(path.string() + " cannot be written");
    }
}

}  // namespace relume::test
