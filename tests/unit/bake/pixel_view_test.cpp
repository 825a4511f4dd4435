// What a pixel sees, and how well its samples tell shares and coverage.
#include "precompute/bake/receivers/pixel/pixel_view.h"

#include "precompute/scene/builtin.h"
#include "precompute/scene/mirror_lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relume::bake {
namespace {

constexpr std::uint32_t kWidth = 48;
constexpr std::uint32_t kHeight = 36;

// Squared errors of coverage and albedo over the pixels in which a reference meets an edge.
struct EdgeError {
    double coverage = 0;
    double albedo = 0;
    std::uint32_t pixels = 0;
};

// A bake without any choice of where to spend: every pixel gets so many positions.
PixelView evenly_sampled(const RayCaster& caster,
                         std::uint32_t x,
                         std::uint32_t y,
                         std::uint32_t samples) {
    PixelView sum;
    const auto side = static_cast<std::uint32_t>(std::sqrt(samples));
    for (std::uint32_t i = 0; i < samples; ++i) {
        // One position alone is the middle of a pixel: of a finer image's.
        const scene::Camera finer(caster.scene().camera, kWidth * side, kHeight * side);
        const PixelView view =
            view_pixel(caster, finer, x * side + i % side, y * side + i / side, 1, 0);
        sum.coverage += view.coverage / static_cast<float>(samples);
        sum.albedo += view.albedo / static_cast<float>(samples);
    }
    return sum;
}

// Of `pixel_samples` as the bake spends them, and of as many at an even rate.
struct EdgeErrors {
    EdgeError spent;
    EdgeError even;
};

EdgeErrors errors_at_edges(const RayCaster& caster, std::uint32_t pixel_samples) {
    const scene::Camera camera(caster.scene().camera, kWidth, kHeight);
    EdgeErrors errors;
    const auto add = [](const PixelView& view, const PixelView& truth, EdgeError& error) {
        error.coverage += std::pow(double{view.coverage - truth.coverage}, 2);
        error.albedo += double{(view.albedo - truth.albedo).length2()};
        ++error.pixels;
    };
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView truth = evenly_sampled(caster, x, y, 256);
            if (truth.coverage == 0 || truth.coverage == 1) {
                continue;
            }
            add(view_pixel(caster, camera, x, y, pixel_samples, 0), truth, errors.spent);
            add(evenly_sampled(caster, x, y, pixel_samples), truth, errors.even);
        }
    }
    return errors;
}

TEST(PixelView, EdgesGetTheSamplesThatSmoothPixelsDoNotNeed) {
    std::uint32_t pixels = 0;
    for (const char* name : {"box", "thin", "table"}) {
        const scene::Scene scene = scene::build_builtin_scene(name);
        const RayCaster caster(scene);
        const EdgeErrors errors = errors_at_edges(caster, 4);
        pixels += errors.spent.pixels;
        EXPECT_LE(std::sqrt(errors.spent.coverage), 0.7 * std::sqrt(errors.even.coverage))
            << name;
        EXPECT_LE(std::sqrt(errors.spent.albedo), 0.7 * std::sqrt(errors.even.albedo)) << name;
    }
    EXPECT_GT(pixels, 50U);
}

TEST(PixelView, SharesAddUpToCoverage) {
    const scene::Scene scene = scene::build_builtin_scene("thin");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView view = view_pixel(caster, camera, x, y, 4, 1);
            float shares = 0;
            for (const ReceiverSurface& surface : view.surfaces) {
                EXPECT_GT(surface.share, 0);
                shares += surface.share;
            }
            EXPECT_NEAR(shares, view.coverage, 1e-5);
        }
    }
}

TEST(PixelView, OneSampleIsTheMiddleWhateverIsAround) {
    const scene::Scene scene = scene::build_builtin_scene("thin");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView view = view_pixel(caster, camera, x, y, 1, 1);
            EXPECT_TRUE(view.coverage == 0 || view.coverage == 1);
            EXPECT_LE(view.surfaces.size(), 1U);
        }
    }
}

// Where the origins of a surface lie in the image, from its upper left pixel.
Imath::V2f pixel_position(const scene::Camera& camera, const Imath::V3f& point) {
    const Imath::V3f to = point - camera.eye();
    const float depth = to.dot(camera.forward());
    const float x = to.dot(camera.right()) / (depth * camera.tan_half_width());
    const float y = to.dot(camera.up()) / (depth * camera.tan_half_height());
    return {(x + 1) * 0.5F * kWidth, (1 - y) * 0.5F * kHeight};
}

TEST(PixelView, OriginsLieAllOverWhatThePixelSeesOfTheSurface) {
    const scene::Scene scene = scene::build_builtin_scene("plane");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; y += 5) {
        for (std::uint32_t x = 0; x < kWidth; x += 7) {
            const PixelView view = view_pixel(caster, camera, x, y, 16, 3);
            ASSERT_EQ(view.surfaces.size(), 1U);
            EXPECT_TRUE(view.surfaces[0].turns.empty());
            // Of each run of four one lies in every quarter of the pixel's width and height.
            for (std::size_t first = 0; first < kPacketSize; first += 4) {
                std::uint32_t columns = 0;
                std::uint32_t rows = 0;
                for (std::size_t lane = first; lane < first + 4; ++lane) {
                    const Imath::V2f at =
                        pixel_position(camera, view.surfaces[0].origins[lane]);
                    columns |= 1U << static_cast<std::uint32_t>(4 * (at.x - std::floor(at.x)));
                    rows |= 1U << static_cast<std::uint32_t>(4 * (at.y - std::floor(at.y)));
                    EXPECT_EQ(std::floor(at.x), static_cast<float>(x));
                    EXPECT_EQ(std::floor(at.y), static_cast<float>(y));
                }
                EXPECT_EQ(columns, 15U);
                EXPECT_EQ(rows, 15U);
            }
        }
    }
}

// What a surface reflects in its mirror direction, all colours together.
float mirrored(const ReceiverSurface& surface) {
    const Imath::V3f value = surface.point.reflect(scene::mirror_direction(surface.point));
    return value.x + value.y + value.z;
}

TEST(PixelView, AVarnishReflectsTheSameWhateverWoodThePixelsMiddleMeets) {
    const scene::Scene scene = scene::build_builtin_scene("table");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    constexpr std::uint32_t kFiner = 6;
    const scene::Camera finer(scene.camera, kFiner * kWidth, kFiner * kHeight);
    std::uint32_t compared = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView view = view_pixel(caster, camera, x, y, 16, 3);
            if (view.surfaces.size() != 1 || view.coverage < 1 ||
                scene.materials[view.surfaces[0].material].name != "inlay") {
                continue;
            }
            float mean = 0;
            for (std::uint32_t i = 0; i < kFiner * kFiner; ++i) {
                const PixelView part = view_pixel(caster, finer, x * kFiner + i % kFiner,
                                                  y * kFiner + i / kFiner, 1, 0);
                mean += mirrored(part.surfaces.at(0)) / (kFiner * kFiner);
            }
            EXPECT_NEAR(mirrored(view.surfaces[0]), mean, 0.03F * mean) << x << ", " << y;
            ++compared;
        }
    }
    EXPECT_GT(compared, 50U);
}

TEST(PixelView, SurfacesThatTurnWithinThePixelHaveSeveralPoints) {
    // A glossy knot: its highlights move by more than their width from pixel to pixel.
    const scene::Scene scene = scene::build_builtin_scene("thin");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    std::uint32_t turning = 0;
    std::uint32_t small = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            for (const ReceiverSurface& surface :
                 view_pixel(caster, camera, x, y, 16, 3).surfaces) {
                turning += surface.turns.empty() ? 0U : 1U;
                EXPECT_LE(surface.turns.size(), std::min(16.0F, std::ceil(32 * surface.share)));
                small += surface.share < 0.25F && surface.turns.size() >= 2 ? 1U : 0U;
                EXPECT_NE(surface.turns.size(), 1U);
            }
        }
    }
    // One normal does not stand for a tube that fills a part of the pixel.
    EXPECT_GT(small, 20U);
    EXPECT_GT(turning, 20U);
}

}  // namespace
}  // namespace relume::bake
