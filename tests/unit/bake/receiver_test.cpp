// What a pixel sees, and how well its samples tell shares and coverage.
#include "precompute/bake/receiver.h"

#include "precompute/scene/builtin.h"

#include <gtest/gtest.h>

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
                         const scene::Camera& camera,
                         std::uint32_t x,
                         std::uint32_t y,
                         std::uint32_t samples) {
    PixelView sum;
    for (std::uint32_t i = 0; i < samples; ++i) {
        // One position alone is the middle of a pixel: of a finer image's.
        const std::uint32_t side = static_cast<std::uint32_t>(std::sqrt(samples));
        const scene::Camera finer(caster.scene().camera, kWidth * side, kHeight * side);
        const PixelView view =
            view_pixel(caster, finer, x * side + i % side, y * side + i / side, 1, 0);
        sum.coverage += view.coverage / static_cast<float>(samples);
        sum.albedo += view.albedo / static_cast<float>(samples);
    }
    return sum;
}

EdgeError error_at_edges(const RayCaster& caster, std::uint32_t pixel_samples) {
    const scene::Camera camera(caster.scene().camera, kWidth, kHeight);
    EdgeError error;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView truth = evenly_sampled(caster, camera, x, y, 256);
            if (truth.coverage == 0 || truth.coverage == 1) {
                continue;
            }
            const PixelView view = view_pixel(caster, camera, x, y, pixel_samples, 0);
            error.coverage += std::pow(double{view.coverage - truth.coverage}, 2);
            error.albedo += double{(view.albedo - truth.albedo).length2()};
            ++error.pixels;
        }
    }
    return error;
}

TEST(Receiver, EdgesGetTheSamplesThatSmoothPixelsDoNotNeed) {
    // Four positions at an even rate leave some 0.15 of a pixel's coverage at an edge.
    for (const char* name : {"box", "thin", "table"}) {
        const scene::Scene scene = scene::build_builtin_scene(name);
        const RayCaster caster(scene);
        const EdgeError error = error_at_edges(caster, 4);
        if (error.pixels == 0) {
            continue;  // the scene fills the image
        }
        EXPECT_LT(std::sqrt(error.coverage / error.pixels), 0.06) << name;
    }
}

TEST(Receiver, SharesAddUpToCoverage) {
    const scene::Scene scene = scene::build_builtin_scene("thin");
    const RayCaster caster(scene);
    const scene::Camera camera(scene.camera, kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const PixelView view = view_pixel(caster, camera, x, y, 4, 1);
            float shares = 0;
            for (const PixelSurface& surface : view.surfaces) {
                EXPECT_GT(surface.share, 0);
                shares += surface.share;
            }
            EXPECT_NEAR(shares, view.coverage, 1e-5);
        }
    }
}

TEST(Receiver, OneSampleIsTheMiddleWhateverIsAround) {
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

}  // namespace
}  // namespace relume::bake
