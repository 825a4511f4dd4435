// Paths that look at the sky in several directions at once find what single ones find, with
// less noise.
#include "precompute/bake/rows/path_tracer.h"

#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/scene/builtin.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace relume::bake {
namespace {

constexpr std::uint32_t kFace = 8;
constexpr std::uint32_t kPaths = 16;
constexpr std::uint32_t kSeeds = 1000;

class PathTracerTest : public testing::Test {
  protected:
    // The response of the surface in a pixel to light from some texels, over its reflectance,
    // by kPaths paths of a pixel that has `samples`.
    [[nodiscard]] double response(std::uint32_t samples,
                                  std::uint32_t bounces,
                                  std::uint64_t seed) const {
        PixelView view = view_pixel(caster_, camera_, 16, 20, 1, 0);
        view.surfaces.at(0).share = static_cast<float>(kPaths) / static_cast<float>(samples);
        const SurfacePaths paths =
            PathTracer(caster_, kFace, bounces, samples, seed)
                .trace_surface(view.surfaces.at(0), sequence_place_from_pixel(16, 20));
        EXPECT_EQ(paths.paths, kPaths);
        EXPECT_EQ(std::accumulate(paths.escapes.begin(), paths.escapes.end(), std::size_t{0},
                                  [](std::size_t sum, const Escapes& escapes) {
                                      return sum + escapes.count;
                                  }),
                  paths.texels.size());
        EXPECT_LE(paths.escapes.size() * sizeof(Escapes) +
                      paths.texels.size() * sizeof(std::uint32_t),
                  PathTracer::most_bytes(bounces, samples));
        double sum = 0;
        auto texel = paths.texels.begin();
        for (const Escapes& escapes : paths.escapes) {
            for (std::uint32_t i = 0; i < escapes.count; ++i, ++texel) {
                // A tenth of all, here and there, as a sky with some bright clouds.
                sum += *texel % 10 == 3 ? double{escapes.weight.y} : 0.0;
            }
        }
        return sum / paths.paths;
    }

    [[nodiscard]] test::SampleMoments<double> moments(std::uint32_t samples,
                                                      std::uint32_t bounces) const {
        test::SampleMoments<double> found(0);
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            found.add(response(samples, bounces, seed));
        }
        return found;
    }

    scene::Scene scene_ = scene::build_builtin_scene("box");
    RayCaster caster_{scene_};
    scene::Camera camera_{scene_.camera, 32, 32};
};

TEST_F(PathTracerTest, LooksChangeTheNoiseAndNotTheMean) {
    constexpr std::uint32_t kTooManyToLook = 4096;
    ASSERT_EQ(PathTracer::looks(1, kTooManyToLook), 0U);
    ASSERT_GT(PathTracer::looks(1, kPaths), 1U);
    for (const std::uint32_t bounces : {1U, 3U}) {
        const auto several = moments(kPaths, bounces);
        const auto single = moments(kTooManyToLook, bounces);
        const double z = (several.mean() - single.mean()) /
                         std::sqrt(several.variance_of_mean() + single.variance_of_mean());
        EXPECT_LT(std::abs(z), 3.5) << several.mean() << " " << single.mean();
        EXPECT_LT(several.variance(), single.variance() / 2);
    }
}

TEST_F(PathTracerTest, ManyPathsLookLessUntilTheyLookNoMore) {
    EXPECT_EQ(PathTracer::looks(0, 1), 0U);
    for (std::uint32_t event = 1; event < 5; ++event) {
        std::uint32_t before = kPacketSize;
        for (std::uint32_t samples = 1; samples <= 1U << 14U; samples *= 2) {
            const std::uint32_t looks = PathTracer::looks(event, samples);
            EXPECT_LE(looks, before);
            EXPECT_NE(looks, 1U);
            before = looks;
        }
        EXPECT_EQ(before, 0U);
    }
}

}  // namespace
}  // namespace relume::bake
