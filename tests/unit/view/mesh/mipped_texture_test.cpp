#include "server/view/mesh/mipped_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace relume::view {
namespace {

using transport::SurfaceTexture;
using transport::TextureWrap;

// Texel (x, y), y from the top, has the colour (x, y, 1).
SurfaceTexture numbered(std::uint32_t width, std::uint32_t height, TextureWrap wrap) {
    SurfaceTexture texture{
        .width = width, .height = height, .wrap_u = wrap, .wrap_v = wrap, .rgb = {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            texture.rgb.emplace_back(static_cast<float>(x));
            texture.rgb.emplace_back(static_cast<float>(y));
            texture.rgb.emplace_back(1.0F);
        }
    }
    return texture;
}

void expect_near(const Imath::V3f& found, const Imath::V3f& expected, float tolerance) {
    EXPECT_LT((found - expected).length(), tolerance) << found << ", expected " << expected;
}

constexpr Imath::V2f kPoint(0, 0);

TEST(MippedTexture, ShowsTexelsAtTheirMiddlesAndBlendsBetween) {
    const SurfaceTexture texture = numbered(4, 8, TextureWrap::clamp);
    const MippedTexture mipped(texture);
    // v runs upwards, and row 0 is the upper one.
    expect_near(mipped.mean({2.5F / 4, 1 - 3.5F / 8}, kPoint, kPoint), {2, 3, 1}, 1e-5F);
    expect_near(mipped.mean({2.0F / 4, 1 - 3.0F / 8}, kPoint, kPoint), {1.5F, 2.5F, 1}, 1e-5F);
    expect_near(mipped.mean({-5, 9}, kPoint, kPoint), {0, 0, 1}, 1e-5F);
    expect_near(mipped.mean({7, -3}, kPoint, kPoint), {3, 7, 1}, 1e-5F);
}

TEST(MippedTexture, RepeatsAndMirrors) {
    const SurfaceTexture repeated = numbered(4, 4, TextureWrap::repeat);
    const SurfaceTexture mirrored = numbered(4, 4, TextureWrap::mirror);
    const MippedTexture repeats(repeated);
    const MippedTexture mirrors(mirrored);
    for (const float turn : {-3.0F, -1.0F, 0.0F, 1.0F, 2.0F, 7.0F}) {
        const Imath::V2f uv(1.5F / 4 + turn, 1 - 2.5F / 4 + turn);
        expect_near(repeats.mean(uv, kPoint, kPoint), {1, 2, 1}, 1e-4F);
        const bool is_turned = std::fmod(turn, 2.0F) != 0;
        expect_near(mirrors.mean(uv, kPoint, kPoint),
                    is_turned ? Imath::V3f(2, 1, 1) : Imath::V3f(1, 2, 1), 1e-4F);
    }
    // The last texel's neighbour is the first one, or itself.
    expect_near(repeats.mean({1, 1 - 2.5F / 4}, kPoint, kPoint), {1.5F, 2, 1}, 1e-5F);
    expect_near(mirrors.mean({1, 1 - 2.5F / 4}, kPoint, kPoint), {3, 2, 1}, 1e-5F);
}

// A pixel that sees all of it sees its mean, also where sides are odd, and where it sees a
// strip of it, that strip's.
TEST(MippedTexture, IsAveragedOverWhatAPixelSees) {
    for (const auto& [width, height] : {std::pair{16U, 16U}, {13U, 7U}, {1U, 9U}, {1U, 1U}}) {
        const SurfaceTexture texture = numbered(width, height, TextureWrap::repeat);
        const MippedTexture mipped(texture);
        const Imath::V3f mean(static_cast<float>(width - 1) / 2,
                              static_cast<float>(height - 1) / 2, 1);
        // Just all of it: up to what blending between texels and levels leaves.
        expect_near(mipped.mean({0.3F, 0.6F}, {1, 0}, {0, 1}), mean, 0.1F);
        expect_near(mipped.mean({0.3F, 0.6F}, {40, 3}, {2, 90}), mean, 0.01F);
    }
    const SurfaceTexture texture = numbered(64, 64, TextureWrap::repeat);
    const MippedTexture mipped(texture);
    // Eight texels of a row: all of the row's colour in y, their mean in x.
    expect_near(mipped.mean({32.0F / 64, 1 - 10.5F / 64}, {8.0F / 64, 0}, {0, 1.0F / 64}),
                {31.5F, 10, 1}, 0.02F);
}

TEST(MippedTexture, IsFiniteWhereverItIsLookedAt) {
    const SurfaceTexture texture = numbered(5, 3, TextureWrap::repeat);
    const MippedTexture mipped(texture);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float not_a_number = std::nanf("");
    for (const float bad : {1e30F, -1e30F, kInfinity, -kInfinity, not_a_number}) {
        for (const Imath::V2f& uv : {Imath::V2f(bad, 0.5F), Imath::V2f(0.5F, bad)}) {
            for (const Imath::V2f& side : {kPoint, Imath::V2f(bad, 0), Imath::V2f(bad, bad)}) {
                const Imath::V3f mean = mipped.mean(uv, side, kPoint);
                EXPECT_TRUE(std::isfinite(mean.x + mean.y + mean.z)) << uv << side;
            }
        }
    }
}

}  // namespace
}  // namespace relume::view
