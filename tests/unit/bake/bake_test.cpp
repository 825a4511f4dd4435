#include "precompute/bake/bake.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

// Names and checksums of the files that two bakes of one input must agree on: all but what is
// there for people, for EXR files carry the time of day.
std::map<std::string, std::uint64_t> checked_files(const fs::path& directory) {
    std::map<std::string, std::uint64_t> files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        const std::string name = fs::relative(entry.path(), directory);
        if (entry.is_regular_file() && !name.starts_with("view/")) {
            files[name] = transport::checksum(transport::FileBytes(entry.path()).bytes());
        }
    }
    return files;
}

BakeParameters small_parameters() {
    return {.width = 48,
            .height = 40,
            .face_resolution = 8,
            .bounces = 1,
            .samples = 8,
            .pixel_samples = 2,
            .pool_radius = 2};
}

CubemapLight constant_light(std::uint32_t n) {
    CubemapLight light;
    light.fill(std::vector<float>(basis::texel_count(n), 1.0F));
    return light;
}

class Bake : public testing::Test {
  protected:
    test::ScratchDirectory scratch_;
    fs::path path_ = scratch_.path() / "scene.relume";
};

TEST_F(Bake, UnoccludedWhiteLambertShowsItsAlbedoUnderConstantLight) {
    BakeParameters parameters = small_parameters();
    parameters.face_resolution = 16;
    parameters.bounces = 0;
    bake(scene::build_builtin_scene("plane"), parameters, path_);
    const auto transport = transport::Transport::open(path_);
    const DenseImage image = relight(*transport, constant_light(16));
    for (const auto& plane : image.rgb) {
        for (const double value : plane) {
            EXPECT_NEAR(value, 1, 0.01);
        }
    }
    EXPECT_EQ(transport->channel_count(), 1U);
}

TEST_F(Bake, TransportNeverGivesMoreThanItGetsUnderConstantLight) {
    BakeParameters parameters = small_parameters();
    parameters.bounces = 3;
    for (const char* name : {"box", "thin", "bowl", "table"}) {
        const fs::path path = scratch_.path() / name;
        bake(scene::build_builtin_scene(name), parameters, path);
        const auto transport = transport::Transport::open(path);
        const DenseImage image = relight(*transport, constant_light(8));
        double brightest = 0;
        for (const auto& plane : image.rgb) {
            for (const double value : plane) {
                EXPECT_GE(value, -0.02) << name;
                brightest = std::max(brightest, value);
            }
        }
        // Noise of eight paths and the quantiser's, over an albedo of at most one.
        EXPECT_LT(brightest, 1.25) << name;
        EXPECT_GT(brightest, 0.3) << name;
    }
}

TEST_F(Bake, BouncesMakeAWhiteBowlBrighterTowardsOne) {
    BakeParameters parameters = small_parameters();
    parameters.width = parameters.height = 32;
    parameters.samples = 64;
    double last = 0;
    for (const std::uint32_t bounces : {0U, 1U, 12U}) {
        parameters.bounces = bounces;
        const fs::path path = scratch_.path() / std::to_string(bounces);
        bake(scene::build_builtin_scene("bowl"), parameters, path);
        const auto transport = transport::Transport::open(path);
        const DenseImage image = relight(*transport, constant_light(8));
        const double centre = image.rgb[1][16 * 32 + 16];
        EXPECT_GT(centre, last + 0.01);
        last = centre;
    }
    EXPECT_NEAR(last, 1, 0.05);
}

TEST_F(Bake, AnyNumberOfThreadsGivesTheSameBytes) {
    BakeParameters parameters = small_parameters();
    const fs::path other = scratch_.path() / "other.relume";
    const scene::Scene scene = scene::build_builtin_scene("box");
    parameters.threads = 1;
    bake(scene, parameters, path_);
    parameters.threads = 4;
    bake(scene, parameters, other);
    const auto a = checked_files(path_);
    EXPECT_EQ(a, checked_files(other));
    EXPECT_TRUE(a.contains("manifest.json"));
    EXPECT_TRUE(fs::exists(path_ / "view/thumbnail.png"));
}

TEST_F(Bake, GoesOnAfterAnInterruptionAndGivesTheSameBytes) {
    BakeParameters parameters = small_parameters();
    parameters.width = 16 * 33;  // one tile row is a shard
    parameters.height = 48;
    parameters.face_resolution = 4;
    const scene::Scene scene = scene::build_builtin_scene("box");
    const fs::path whole = scratch_.path() / "whole.relume";
    EXPECT_EQ(bake(scene, parameters, whole).shards, 3U);

    std::uint64_t done = 0;
    const BakeHooks stop_in_second_shard{
        .on_progress = [&](const BakeProgress& progress) { done = progress.receivers_done; },
        .should_stop = [&] { return done > 16U * 33U * 16U + 400U; }};
    parameters.threads = 1;
    EXPECT_THROW(bake(scene, parameters, path_, stop_in_second_shard), BakeInterrupted);
    EXPECT_FALSE(fs::exists(path_ / "manifest.json"));
    EXPECT_TRUE(fs::exists(path_ / "shards/00000.shard"));
    EXPECT_FALSE(fs::exists(path_ / "shards/00001.shard"));

    EXPECT_EQ(bake(scene, parameters, path_).shards_resumed, 1U);
    EXPECT_EQ(checked_files(path_), checked_files(whole));
}

TEST_F(Bake, ShardsOfOtherInputsAreNotTakenOver) {
    BakeParameters parameters = small_parameters();
    const scene::Scene scene = scene::build_builtin_scene("box");
    bake(scene, parameters, path_);
    const auto before = checked_files(path_);
    parameters.seed = 1;
    EXPECT_EQ(bake(scene, parameters, path_).shards_resumed, 0U);
    EXPECT_NE(checked_files(path_).at("shards/00000.shard"), before.at("shards/00000.shard"));
    EXPECT_TRUE(find_faults(path_).empty());
}

TEST_F(Bake, ColourIsStoredOnlyWhereTransportHasIt) {
    BakeParameters parameters = small_parameters();
    bake(scene::build_builtin_scene("box"), parameters, path_);
    EXPECT_EQ(transport::Transport::open(path_)->channel_count(), 3U);
    EXPECT_GT(describe(path_).at("measured").at("chroma_residual").get<double>(), 1e-3);
}

TEST_F(Bake, QuantisationErrorIsMeasuredAndFallsWithBits) {
    BakeParameters parameters = small_parameters();
    parameters.face_resolution = 16;
    double last = 1;
    for (const std::uint32_t bits : {6U, 7U, 8U}) {
        parameters.bits = bits;
        const fs::path path = scratch_.path() / std::to_string(bits);
        bake(scene::build_builtin_scene("table"), parameters, path);
        const double error = describe(path)
                                 .at("measured")
                                 .at("quantisation_error")
                                 .at("natural")
                                 .at("relative_l2");
        EXPECT_GT(error, 0);
        EXPECT_LT(error, 0.8 * last);
        last = error;
    }
}

TEST_F(Bake, FindsEveryFileThatIsBroken) {
    bake(scene::build_builtin_scene("plane"), small_parameters(), path_);
    EXPECT_TRUE(find_faults(path_).empty());
    fs::resize_file(path_ / "shards/00000.shard", 500);
    const auto faults = find_faults(path_);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("00000.shard"), std::string::npos);
    fs::remove(path_ / "manifest.json");
    EXPECT_EQ(find_faults(path_).size(), 1U);
}

TEST_F(Bake, RefusesParametersOutOfRangeByName) {
    const scene::Scene scene = scene::build_builtin_scene("plane");
    const auto refused = [&](auto change) {
        BakeParameters parameters = small_parameters();
        change(parameters);
        try {
            bake(scene, parameters, path_);
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    EXPECT_NE(refused([](auto& p) { p.width = 0; }).find("width"), std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.height = 20000; }).find("height"), std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.face_resolution = 48; }).find("light resolution is 48"),
              std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.bits = 9; }).find("bits is 9"), std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.samples = 0; }).find("samples"), std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.pool_radius = 99; }).find("pool"), std::string::npos);
    EXPECT_NE(refused([](auto& p) { p.shrinkage = std::nanf(""); }).find("shrinkage"),
              std::string::npos);
    EXPECT_NE(refused([](auto& p) {
                  p.width = 4096;
                  p.samples = 100000;
              }).find("paths"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(path_ / "manifest.json"));
}

}  // namespace
}  // namespace relume::bake
