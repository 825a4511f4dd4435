#include "client/cli/image_file.h"

#include "client/cli/client_error.h"
#include "protocol/wire/display.h"
#include "tests/support/scratch_directory.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>

namespace relume::cli {
namespace {

namespace fs = std::filesystem;

struct Pixels {
    OIIO::ImageSpec spec;
    std::vector<float> values;

    [[nodiscard]] float at(std::size_t pixel, std::size_t channel) const {
        return values[pixel * static_cast<std::size_t>(spec.nchannels) + channel];
    }
};

Pixels read(const fs::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) {
        throw std::runtime_error(OIIO::geterror());
    }
    Pixels pixels{.spec = input->spec(), .values = {}};
    pixels.values.resize(static_cast<std::size_t>(pixels.spec.image_pixels()) *
                         static_cast<std::size_t>(pixels.spec.nchannels));
    input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.values.data());
    return pixels;
}

wire::HalfImage gradient(bool has_alpha) {
    wire::HalfImage image{.width = 5, .height = 3, .has_alpha = has_alpha, .values = {}};
    for (std::size_t p = 0; p < image.plane_count(); ++p) {
        for (std::size_t i = 0; i < image.plane_size(); ++i) {
            const auto value = static_cast<float>(i) / 15.0F;
            image.values.emplace_back(p == 3 ? 0.5F : value * static_cast<float>(p + 1));
        }
    }
    return image;
}

wire::ImageHeader header_of(const wire::HalfImage& image) {
    return {.encoding = wire::ImageEncoding::half_planes,
            .width = image.width,
            .height = image.height,
            .revision = 12,
            .exact = true,
            .has_alpha = image.has_alpha};
}

TEST(ImageFiles, ExrHoldsTheVeryHalves) {
    const test::ScratchDirectory scratch;
    for (const bool has_alpha : {false, true}) {
        const wire::HalfImage image = gradient(has_alpha);
        const fs::path path = scratch.path() / "image.exr";
        write_image_file(path, image, header_of(image), {});
        const Pixels pixels = read(path);
        ASSERT_EQ(pixels.spec.nchannels, has_alpha ? 4 : 3);
        EXPECT_EQ(pixels.spec.width, 5);
        EXPECT_EQ(pixels.spec.height, 3);
        EXPECT_EQ(pixels.spec.format, OIIO::TypeDesc::HALF);
        EXPECT_EQ(pixels.spec.get_string_attribute("relume:revision"), "12");
        for (std::size_t c = 0; c < image.plane_count(); ++c) {
            for (std::size_t i = 0; i < image.plane_size(); ++i) {
                EXPECT_EQ(pixels.at(i, c), static_cast<float>(image.plane(c)[i]));
            }
        }
    }
}

TEST(ImageFiles, HdrHoldsTheColoursToItsPrecision) {
    const test::ScratchDirectory scratch;
    const wire::HalfImage image = gradient(true);
    write_image_file(scratch.path() / "image.hdr", image, header_of(image), {});
    const Pixels pixels = read(scratch.path() / "image.hdr");
    ASSERT_EQ(pixels.spec.nchannels, 3);
    for (std::size_t i = 0; i < image.plane_size(); ++i) {
        // RGBE: eight bits below the brightest channel's exponent.
        EXPECT_NEAR(pixels.at(i, 0), static_cast<float>(image.plane(0)[i]), 3.0F / 128);
    }
}

TEST(ImageFiles, PngIsDisplayReferredWithStraightAlpha) {
    const test::ScratchDirectory scratch;
    const wire::Display display{.exposure_stops = 0.5, .tone = wire::Tone::filmic};
    for (const bool has_alpha : {false, true}) {
        const wire::HalfImage image = gradient(has_alpha);
        write_image_file(scratch.path() / "image.png", image, header_of(image), display);
        const Pixels pixels = read(scratch.path() / "image.png");
        ASSERT_EQ(pixels.spec.nchannels, has_alpha ? 4 : 3);
        const float coverage = has_alpha ? 0.5F : 1.0F;
        for (std::size_t i = 0; i < image.plane_size(); ++i) {
            const int code = wire::code_from_linear(
                static_cast<float>(image.plane(1)[i]) / coverage, display);
            // OpenImageIO multiplies alpha in again when it reads, with rounding to a code.
            EXPECT_NEAR(pixels.at(i, 1) * 255.0F, static_cast<float>(code) * coverage, 1.01F);
        }
    }
}

TEST(ImageFiles, AJpegIsKeptAsItIsOrDecoded) {
    const test::ScratchDirectory scratch;
    const wire::HalfImage image = gradient(false);
    const wire::ImageHeader header = header_of(image);
    write_image_file(scratch.path() / "a.jpg", image, header, {});
    std::ifstream file(scratch.path() / "a.jpg", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto jpeg = std::as_bytes(std::span(text));

    write_image_file(scratch.path() / "b.jpg", jpeg, header);
    std::ifstream copy(scratch.path() / "b.jpg", std::ios::binary);
    EXPECT_EQ(text, std::string(std::istreambuf_iterator<char>(copy), {}));

    write_image_file(scratch.path() / "c.png", jpeg, header);
    EXPECT_EQ(read(scratch.path() / "c.png").spec.width, 5);

    wire::ImageHeader other = header;
    other.width = 6;
    EXPECT_THROW(write_image_file(scratch.path() / "d.png", jpeg, other), ClientError);
    EXPECT_THROW(write_image_file(scratch.path() / "d.png", jpeg.first(20), header),
                 ClientError);
    EXPECT_THROW(write_image_file(scratch.path() / "d.exr", jpeg, header), ClientError);
    EXPECT_FALSE(fs::exists(scratch.path() / "d.png"));
}

TEST(ImageFiles, AFailureLeavesNothingBehindAndTheOldFileWhole) {
    const test::ScratchDirectory scratch;
    const wire::HalfImage image = gradient(false);
    EXPECT_THROW(write_image_file(scratch.path() / "x.bmp", image, header_of(image), {}),
                 ClientError);
    EXPECT_THROW(write_image_file(scratch.path() / "no" / "x.exr", image, header_of(image), {}),
                 ClientError);
    EXPECT_TRUE(fs::is_empty(scratch.path()));
    write_file(scratch.path() / "t.csv", std::string_view("one"));
    write_file(scratch.path() / "t.csv", std::string_view("two"));
    std::ifstream file(scratch.path() / "t.csv");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "two");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
}

}  // namespace
}  // namespace relume::cli
