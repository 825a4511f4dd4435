// relume-half-distance: how far an image that travelled as half floats is from a reference of
// full precision, not counting what any rounding to halves loses: the smallest relative L2
// distance from the reference of an image that would have been rounded to what arrived.
#include <Imath/half.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int kColours = 3;

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  // row by row, interleaved
};

Picture read(const std::string& file) {
    const auto input = OIIO::ImageInput::open(file);
    if (!input) {
        throw std::runtime_error(fmt::format("{}: {}", file, OIIO::geterror()));
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < kColours) {
        throw std::runtime_error(
            fmt::format("{}: found {} channels, expected R, G, B", file, spec.nchannels));
    }
    Picture picture{spec.width, spec.height, {}};
    picture.rgb.resize(static_cast<std::size_t>(kColours) *
                       static_cast<std::size_t>(spec.width) *
                       static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, 0, kColours, OIIO::TypeDesc::FLOAT, picture.rgb.data())) {
        throw std::runtime_error(fmt::format("{}: {}", file, input->geterror()));
    }
    return picture;
}

float half_from(std::uint16_t bits) {
    half value;
    value.setBits(bits);
    return value;
}

// Distance of `reference` from the values that are rounded to `received`.
double distance_beyond_rounding(float received, float reference) {
    constexpr std::uint16_t kMagnitude = 0x7FFF;
    const auto magnitude =
        static_cast<std::uint16_t>(half(std::abs(received)).bits() & kMagnitude);
    const double below =
        magnitude == 0 ? -double{half_from(1)} : double{half_from(magnitude - 1)};
    const double at = double{half_from(magnitude)};
    const double above = double{half_from(static_cast<std::uint16_t>(magnitude + 1))};
    const double value = std::copysign(1.0, double{received}) * double{reference};
    return std::max({(at + below) / 2 - value, value - (at + above) / 2, 0.0});
}

double relative_distance(const Picture& received, const Picture& reference) {
    if (received.width != reference.width || received.height != reference.height) {
        throw std::runtime_error(fmt::format("found {}x{} pixels, expected {}x{}",
                                             received.width, received.height, reference.width,
                                             reference.height));
    }
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
        const double distance = distance_beyond_rounding(received.rgb[i], reference.rgb[i]);
        difference += distance * distance;
        norm += double{reference.rgb[i]} * double{reference.rgb[i]};
    }
    return std::sqrt(difference / norm);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: relume-half-distance RECEIVED.exr REFERENCE.exr\n");
        return 2;
    }
    try {
        std::printf("%.17g\n", relative_distance(read(argv[1]), read(argv[2])));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "relume-half-distance: %s\n", error.what());
        return 1;
    }
    return 0;
}
