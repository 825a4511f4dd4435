#include "precompute/scene/texture.h"

#include "precompute/scene/error.h"
#include "precompute/scene/srgb.h"
#include "tests/support/scratch_directory.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

SceneFault fault_of(const auto& action) {
    try {
        action();
    } catch (const SceneError& error) {
        return error.fault();
    }
    return SceneFault::unknown_name;
}

// One row of greys.
Texture greys(const std::vector<float>& values, Wrap wrap) {
    std::vector<half> rgba;
    for (const float value : values)
        rgba.insert(rgba.end(), {half(value), half(value), half(value), half(1.0F)});
    Texture texture("greys", static_cast<std::uint32_t>(values.size()), 1, std::move(rgba));
    texture.set_wrap(wrap, wrap);
    return texture;
}

void write_image(const std::string& path,
                 int width,
                 int height,
                 int channels,
                 OIIO::TypeDesc type,
                 const std::vector<float>& values) {
    const auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output);
    OIIO::ImageSpec spec(width, height, channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    ASSERT_TRUE(output->open(path, spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(output->close());
}

TEST(Texture, FiltersBilinearlyBetweenTexelCentres) {
    const Texture texture = greys({0, 1, 0.5F, 0.25F}, Wrap::repeat);
    EXPECT_FLOAT_EQ(texture.evaluate({0.125F, 0.5F}).x, 0.0F);
    EXPECT_FLOAT_EQ(texture.evaluate({0.375F, 0.5F}).x, 1.0F);
    EXPECT_FLOAT_EQ(texture.evaluate({0.25F, 0.5F}).x, 0.5F);
    EXPECT_FLOAT_EQ(texture.evaluate({0.5F, 0.5F}).x, 0.75F);
}

TEST(Texture, WrapsAsAsked) {
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::repeat).evaluate({0.0F, 0.5F}).x, 0.5F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::repeat).evaluate({1.75F, 0.5F}).x, 1.0F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::repeat).evaluate({-0.25F, 0.5F}).x, 1.0F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::clamp).evaluate({0.0F, 0.5F}).x, 0.0F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::clamp).evaluate({7.0F, 0.5F}).x, 1.0F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::mirror).evaluate({1.25F, 0.5F}).x, 1.0F);
    EXPECT_FLOAT_EQ(greys({0, 1}, Wrap::mirror).evaluate({-0.25F, 0.5F}).x, 0.0F);
}

TEST(Texture, VGrowsUpwards) {
    const auto texel = [](float v) {
        return std::vector<half>{half(v), half(v), half(v), half(1)};
    };
    std::vector<half> rgba = texel(0.9F);
    const std::vector<half> lower = texel(0.1F);
    rgba.insert(rgba.end(), lower.begin(), lower.end());
    const Texture texture("two rows", 1, 2, std::move(rgba));
    EXPECT_NEAR(texture.evaluate({0.5F, 0.75F}).x, 0.9F, 1e-3F);
    EXPECT_NEAR(texture.evaluate({0.5F, 0.25F}).x, 0.1F, 1e-3F);
}

TEST(Texture, SurvivesCoordinatesThatAreNone) {
    const Texture texture = greys({0.25F, 0.75F}, Wrap::repeat);
    for (const float u : {std::nanf(""), INFINITY, -INFINITY, 1e30F}) {
        const float value = texture.evaluate({u, u}).x;
        EXPECT_GE(value, 0.25F);
        EXPECT_LE(value, 0.75F);
    }
}

TEST(Texture, RefusesSizesThatDoNotFit) {
    EXPECT_EQ(fault_of([] { Texture("t", 2, 2, std::vector<half>(15)); }),
              SceneFault::bad_texture);
    EXPECT_EQ(fault_of([] { Texture("t", 0, 2, {}); }), SceneFault::bad_texture);
    EXPECT_EQ(fault_of([] { Texture("t", 8193, 1, std::vector<half>(4 * 8193)); }),
              SceneFault::too_large);
}

TEST(TextureFile, DecodesPicturesFromSrgbAndDataAsItIs) {
    const test::ScratchDirectory scratch;
    const std::string path = (scratch.path() / "half.png").string();
    write_image(path, 1, 1, 3, OIIO::TypeDesc::UINT8, {128.0F / 255, 64.0F / 255, 1});
    const Imath::V4f colour = load_texture(path, TextureContent::colour).evaluate({0.5F, 0.5F});
    EXPECT_NEAR(colour.x, linear_from_srgb(128.0F / 255), 2e-4F);
    EXPECT_NEAR(colour.x, 0.2158F, 2e-4F);
    EXPECT_NEAR(colour.z, 1.0F, 1e-6F);
    EXPECT_EQ(colour.w, 1.0F);
    const Imath::V4f data = load_texture(path, TextureContent::data).evaluate({0.5F, 0.5F});
    EXPECT_NEAR(data.x, 128.0F / 255, 3e-4F);
}

TEST(TextureFile, ReadsEveryKindOfChannelsAndDepth) {
    const test::ScratchDirectory scratch;
    const auto path = [&](const char* name) { return (scratch.path() / name).string(); };
    write_image(path("grey.png"), 2, 1, 1, OIIO::TypeDesc::UINT8, {0, 1});
    EXPECT_EQ(load_texture(path("grey.png"), TextureContent::data).evaluate({0.75F, 0.5F}),
              Imath::V4f(1, 1, 1, 1));
    write_image(path("cut.png"), 1, 1, 4, OIIO::TypeDesc::UINT8, {1, 1, 1, 0});
    EXPECT_EQ(load_texture(path("cut.png"), TextureContent::data).evaluate({0.5F, 0.5F}),
              Imath::V4f(1, 1, 1, 0));  // the colour is not darkened by the alpha
    write_image(path("deep.png"), 1, 1, 3, OIIO::TypeDesc::UINT16, {0.5F, 0.5F, 0.5F});
    EXPECT_NEAR(load_texture(path("deep.png"), TextureContent::colour).evaluate({0.5F, 0.5F}).x,
                0.2140F, 3e-4F);
    write_image(path("linear.exr"), 1, 1, 3, OIIO::TypeDesc::HALF, {0.5F, 2.0F, 0.25F});
    EXPECT_EQ(load_texture(path("linear.exr"), TextureContent::colour).evaluate({0.5F, 0.5F}),
              Imath::V4f(0.5F, 2.0F, 0.25F, 1));
}

TEST(TextureFile, InMemoryIsAsOnDisk) {
    const test::ScratchDirectory scratch;
    const std::string path = (scratch.path() / "t.png").string();
    write_image(path, 2, 1, 3, OIIO::TypeDesc::UINT8, {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F});
    std::ifstream stream(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
    const Texture from_disk = load_texture(path, TextureContent::colour);
    const Texture from_memory = decode_texture("*0.png", bytes, TextureContent::colour);
    ASSERT_EQ(from_disk.texels().size(), from_memory.texels().size());
    for (std::size_t i = 0; i < from_disk.texels().size(); ++i)
        EXPECT_EQ(from_disk.texels()[i].bits(), from_memory.texels()[i].bits());
}

TEST(TextureFile, RefusesWhatIsMissingBrokenOrHuge) {
    const test::ScratchDirectory scratch;
    const auto path = [&](const char* name) { return (scratch.path() / name).string(); };
    EXPECT_EQ(fault_of([&] { (void)load_texture(path("none.png"), TextureContent::colour); }),
              SceneFault::missing_file);
    std::ofstream(path("broken.png")) << "this is no picture";
    EXPECT_EQ(fault_of([&] { (void)load_texture(path("broken.png"), TextureContent::colour); }),
              SceneFault::bad_texture);
    write_image(path("wide.png"), 9000, 1, 1, OIIO::TypeDesc::UINT8, std::vector<float>(9000));
    EXPECT_EQ(fault_of([&] { (void)load_texture(path("wide.png"), TextureContent::colour); }),
              SceneFault::too_large);
    const std::vector<std::uint8_t> garbage(100, 7);
    EXPECT_EQ(
        fault_of([&] { (void)decode_texture("*1.jpg", garbage, TextureContent::colour); }),
        SceneFault::bad_texture);
}

}  // namespace
}  // namespace relume::scene
