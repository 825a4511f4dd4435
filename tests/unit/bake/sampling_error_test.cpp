// The error that a bake states of its own sampling.
#include "precompute/bake/blocks/sampling_error.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/shard_baker.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/cubemap_projection.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <memory>
#include <vector>

namespace relume::bake {
namespace {

BakeParameters parameters_with_seed(std::uint64_t seed) {
    return {.width = 64,
            .height = 48,
            .face_resolution = 8,
            .bounces = 1,
            .samples = 8,
            .pixel_samples = 2,
            .pool_radius = 2,
            .seed = seed};
}

// All that the bake does, but for what it stores.
transport::SamplingError stated(const scene::Scene& scene, const BakeParameters& parameters) {
    const RayCaster caster(scene);
    const PixelReceivers receivers(caster, parameters);
    BakeParameters with_other_seed = parameters;
    with_other_seed.seed = other_seed(parameters);
    const PixelReceivers other(caster, with_other_seed);
    LightRows rows(caster, receivers, parameters);
    const Quantisation quantisation = plan_quantisation(rows, parameters.bits, parameters.seed);
    rows.move_to(0, receivers.cluster_count());
    const BakedShard shard = ShardBaker(rows, quantisation, parameters.seed)
                                 .bake({.cluster_count = receivers.cluster_count(),
                                        .block_count = receivers.cluster_count()},
                                       [](auto...) { return true; });
    return measure_sampling_error(caster, receivers, other, parameters, shard.notes.samples);
}

TEST(SamplingError, FallsWithMoreSamples) {
    const scene::Scene scene = scene::build_builtin_scene("box");
    BakeParameters parameters = parameters_with_seed(3);
    const double few = stated(scene, parameters).natural;
    parameters.samples *= 16;
    parameters.pixel_samples *= 4;
    parameters.edge_samples *= 4;
    EXPECT_LT(stated(scene, parameters).natural, 0.6 * few);
}

TEST(SamplingError, IsSmallWhereNothingIsLeftToChance) {
    // An open plane without interreflection: every texel's ray sees the sky.
    BakeParameters parameters = parameters_with_seed(4);
    parameters.bounces = 0;
    parameters.pixel_samples = 1;
    EXPECT_LT(stated(scene::build_builtin_scene("plane"), parameters).natural, 1e-3);
}

TEST(SamplingError, SeesWhatTwoBakesShare) {
    // Shrinkage so strong that hardly any detail of interreflection is left, alike in every
    // bake.
    const scene::Scene scene = scene::build_builtin_scene("bowl");
    BakeParameters parameters = parameters_with_seed(5);
    parameters.width = 32;
    parameters.height = 32;
    parameters.samples = 64;
    const double sharp = stated(scene, parameters).natural;
    parameters.shrinkage = 10;
    EXPECT_GT(stated(scene, parameters).natural, 1.3 * sharp);
}

// ‖B − B′‖²/2 over ‖B‖², B and B′ two bakes that differ in their seed alone: the mean over all
// pairs of bakes and over lights.
class TwoBakes {
  public:
    explicit TwoBakes(const BakeParameters& parameters)
        : projection_(basis::CubemapProjection::onto(
              basis::CubemapBasis::haar(parameters.face_resolution))) {}

    void add(const transport::Transport& transport) {
        std::vector<DenseImage>& images = images_.emplace_back();
        for (std::uint64_t seed = 0; seed < kLights; ++seed) {
            images.push_back(under(transport, natural_light(projection_->basis(), seed)));
        }
        for (std::uint64_t seed = 0; seed < kLights; ++seed) {
            images.push_back(under(transport, sun_light(*projection_, seed)));
        }
    }
    [[nodiscard]] transport::SamplingError noise() const {
        return {.natural = noise_of(0), .sun = noise_of(kLights)};
    }

  private:
    static constexpr std::uint64_t kLights = 6;

    [[nodiscard]] DenseImage under(const transport::Transport& transport,
                                   const std::vector<float>& coefficients) const {
        std::vector<float> texels(basis::texel_count(projection_->basis().face_resolution()));
        projection_->reconstruct_radiance(coefficients, texels);
        return relight(transport, CubemapLight{texels, texels, texels});
    }
    [[nodiscard]] double noise_of(std::size_t first_light) const {
        double difference = 0;
        double energy = 0;
        for (std::size_t i = 0; i < images_.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                for (std::size_t light = first_light; light < first_light + kLights; ++light) {
                    add_pair(images_[i][light], images_[j][light], difference, energy);
                }
            }
        }
        return std::sqrt(difference / energy);
    }
    static void add_pair(const DenseImage& a,
                         const DenseImage& b,
                         double& difference,
                         double& energy) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < a.rgb[c].size(); ++i) {
                const double d = a.rgb[c][i] - b.rgb[c][i];
                difference += d * d / 2;
                energy += a.rgb[c][i] * b.rgb[c][i];
            }
        }
    }

    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::vector<std::vector<DenseImage>> images_;  // by bake, by light
};

// What is stated is the noise and the bias together, and one standard error more.
TEST(SamplingError, IsNoLessThanWhatTwoBakesDifferBy) {
    for (const char* const name : {"box", "table", "thin"}) {
        const scene::Scene scene = scene::build_builtin_scene(name);
        constexpr std::uint64_t kBakes = 4;
        TwoBakes bakes(parameters_with_seed(0));
        transport::SamplingError mean{};
        for (std::uint64_t seed = 1; seed <= kBakes; ++seed) {
            const test::ScratchDirectory folder;
            bake(scene, parameters_with_seed(seed), folder.path() / "scene.relume");
            const auto transport = transport::Transport::open(folder.path() / "scene.relume");
            bakes.add(*transport);
            mean.natural += transport->manifest().sampling_error->natural / kBakes;
            mean.sun += transport->manifest().sampling_error->sun / kBakes;
        }
        const transport::SamplingError noise = bakes.noise();
        EXPECT_GT(mean.natural, noise.natural / 1.25) << name;
        EXPECT_LT(mean.natural, noise.natural * 2) << name;
        EXPECT_GT(mean.sun, noise.sun / 1.25) << name;
        EXPECT_LT(mean.sun, noise.sun * 2) << name;
    }
}

TEST(SamplingError, IsTheSameOnAnyNumberOfThreads) {
    const scene::Scene scene = scene::build_builtin_scene("thin");
    const transport::SamplingError many = stated(scene, parameters_with_seed(6));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const transport::SamplingError alone = stated(scene, parameters_with_seed(6));
    EXPECT_EQ(alone.natural, many.natural);
    EXPECT_EQ(alone.sun, many.sun);
}

}  // namespace
}  // namespace relume::bake
