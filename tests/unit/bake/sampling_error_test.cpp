// The error that a bake states of its own sampling.
#include "precompute/bake/blocks/sampling_error.h"

#include "precompute/bake/blocks/shard_baker.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/scene/builtin.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

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
    const LightTexels texels(parameters.face_resolution, parameters.seed);
    const PathTracer tracer(caster, parameters);
    const RowBaker rows(caster, texels, parameters);
    const Quantisation quantisation = plan_quantisation(rows, receivers, tracer, parameters);
    TracedReceivers traced(receivers, tracer, parameters);
    traced.move_to(0, receivers.block_count());
    const BakedShard shard =
        ShardBaker(rows, traced, quantisation, parameters.seed)
            .bake(0, receivers.block_count(), [](auto...) { return true; });
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
