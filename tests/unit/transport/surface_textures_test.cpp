// Values between the texels of a texture.
#include "protocol/transport/surface_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace relume::transport {
namespace {

SurfaceTexture texture_of(std::uint32_t width,
                          std::uint32_t height,
                          std::initializer_list<float> reds) {
    SurfaceTexture texture{.width = width, .height = height, .rgb = {}};
    for (const float red : reds) {
        texture.rgb.insert(texture.rgb.end(), {half(red), half(9.0F), half(9.0F)});
    }
    return texture;
}

TEST(RedAt, IsTheTexelInItsMiddleAndBilinearBetween) {
    // Rows from the top, v upwards.
    const SurfaceTexture texture = texture_of(2, 2, {1, 2, 4, 8});
    EXPECT_EQ(red_at(texture, {0.25F, 0.75F}), 1);
    EXPECT_EQ(red_at(texture, {0.75F, 0.75F}), 2);
    EXPECT_EQ(red_at(texture, {0.25F, 0.25F}), 4);
    EXPECT_EQ(red_at(texture, {0.75F, 0.25F}), 8);
    EXPECT_EQ(red_at(texture, {0.5F, 0.75F}), 1.5F);
    EXPECT_EQ(red_at(texture, {0.5F, 0.5F}), 3.75F);
}

TEST(RedAt, GoesOnBeyondTheEdgeAsTheTextureSays) {
    SurfaceTexture texture = texture_of(2, 1, {1, 2});
    const auto at = [&](TextureWrap wrap, float u) {
        texture.wrap_u = wrap;
        return red_at(texture, {u, 0.5F});
    };
    EXPECT_EQ(at(TextureWrap::repeat, 1.25F), 1);
    EXPECT_EQ(at(TextureWrap::repeat, -0.25F), 2);
    EXPECT_EQ(at(TextureWrap::repeat, 1.0F), 1.5F);
    EXPECT_EQ(at(TextureWrap::mirror, 1.25F), 2);
    EXPECT_EQ(at(TextureWrap::mirror, 1.75F), 1);
    EXPECT_EQ(at(TextureWrap::mirror, -0.25F), 1);
    EXPECT_EQ(at(TextureWrap::clamp, 1.75F), 2);
    EXPECT_EQ(at(TextureWrap::clamp, -3.0F), 1);
}

TEST(RedAt, IsOneOfTheTexelsHoweverFarAway) {
    SurfaceTexture texture = texture_of(3, 1, {1, 2, 3});
    for (const TextureWrap wrap :
         {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
        texture.wrap_u = texture.wrap_v = wrap;
        for (const float far : {1e6F, -1e9F, 1e30F, std::numeric_limits<float>::infinity(),
                                std::numeric_limits<float>::quiet_NaN()}) {
            const float red = red_at(texture, {far, -far});
            EXPECT_GE(red, 1) << far;
            EXPECT_LE(red, 3) << far;
        }
    }
}

}  // namespace
}  // namespace relume::transport
