// Bakes of vertices whose material reflects as was measured.
#include "precompute/bake/bake.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/relight.h"
#include "precompute/factors/error.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/files/error.h"
#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/transport.h"
#include "tests/support/merl_file.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

// A broad highlight, so that few terms hold it.
const scene::Material& satin() {
    static const scene::Material material{.name = "satin",
                                          .model = scene::BsdfModel::phong,
                                          .base_colour = {0.3F, 0.2F, 0.1F},
                                          .specular = {0.3F, 0.3F, 0.3F},
                                          .exponent = 3};
    return material;
}

Imath::V3f satin_brdf(const Imath::V3f& wi, const Imath::V3f& wo) {
    return satin().bsdf_at({}, {}, {1, 1, 1}).evaluate(wi, wo);
}

scene::Scene plane_of(const scene::Material& material) {
    scene::Scene scene = scene::build_builtin_scene("plane");
    scene.materials[0] = material;
    scene.camera = {
        .name = "low", .eye = {0, 1, 2.2F}, .look_at = {0, 0, 0}, .vertical_fov_degrees = 20};
    return scene;
}

BakeParameters parameters_of_mesh() {
    BakeParameters parameters;
    parameters.receivers = ReceiverKind::vertices;
    parameters.width = 32;
    parameters.height = 24;
    parameters.face_resolution = 8;
    parameters.bounces = 0;
    parameters.vertices = 200;
    parameters.terms = 6;
    return parameters;
}

CubemapLight sky() {
    CubemapLight light;
    for (auto& plane : light) {
        plane.resize(basis::texel_count(8));
        for (std::size_t texel = 0; texel < plane.size(); ++texel) {
            const Imath::V3f d =
                basis::direction_from_texel(8, basis::texel_from_index(8, texel));
            plane[texel] = 1 + 0.9F * (d.y + 0.5F * d.x);
        }
    }
    return light;
}

class MeasuredBake : public testing::Test {
  protected:
    [[nodiscard]] fs::path file_of(const std::vector<std::byte>& bytes) const {
        const fs::path path = scratch_.path() / "satin.binary";
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return path;
    }
    [[nodiscard]] DenseImage image(const scene::Scene& scene,
                                   const BakeParameters& parameters,
                                   std::span<const MeasuredBrdf> measured = {}) {
        fs::remove_all(directory_);
        bake(scene, parameters, directory_, {}, measured);
        return relight(*transport::Transport::open(directory_), sky());
    }

    test::ScratchDirectory scratch_;
    const fs::path directory_ = scratch_.path() / "plane.relume";
};

// A file that has the formula's values shows what the formula does.
TEST_F(MeasuredBake, ShowsWhatWasMeasured) {
    const BakeParameters parameters = parameters_of_mesh();
    const DenseImage expected = image(plane_of(satin()), parameters);
    const scene::Scene grey = plane_of({.name = "coat", .base_colour = {0.5F, 0.5F, 0.5F}});
    const MeasuredBrdf coat =
        read_measured_brdf("coat=" + file_of(test::merl_file(satin_brdf)).string());
    const DenseImage found = image(grey, parameters, {&coat, 1});
    double difference = 0;
    double norm = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t pixel = 0; pixel < found.rgb[c].size(); ++pixel) {
            difference += std::pow(found.rgb[c][pixel] - expected.rgb[c][pixel], 2);
            norm += std::pow(expected.rgb[c][pixel], 2);
        }
    }
    EXPECT_LT(std::sqrt(difference / norm), 0.03);
    const nlohmann::json measured = transport::Transport::open(directory_)->manifest().measured;
    const nlohmann::json& brdf = measured.at("brdfs").at(0);
    EXPECT_EQ(brdf.at("name"), "coat");
    EXPECT_EQ(brdf.at("terms"), 6);
    EXPECT_EQ(brdf.at("error_of_terms").size(), 10U);
    EXPECT_LT(brdf.at("error").get<double>(), 0.2);
    // Values below the horizon are negative in such files, and told.
    EXPECT_NE(measured.at("materials").dump().find("are negative"), std::string::npos);
    EXPECT_TRUE(find_faults(directory_).empty());
}

// Another file is another bake, with or without the same name.
TEST_F(MeasuredBake, IsOfTheFilesContent) {
    const scene::Scene scene = plane_of({.name = "coat"});
    const auto fingerprint = [&](std::span<const MeasuredBrdf> measured) {
        (void)image(scene, parameters_of_mesh(), measured);
        return transport::Transport::open(directory_)->manifest().fingerprint;
    };
    std::vector<std::byte> bytes = test::merl_file(satin_brdf);
    const MeasuredBrdf first = read_measured_brdf("coat=" + file_of(bytes).string());
    const double twice = 2 * 0.3 * 1500;
    std::memcpy(&bytes[12], &twice, sizeof(twice));
    const MeasuredBrdf second = read_measured_brdf("coat=" + file_of(bytes).string());
    const auto without = fingerprint({});
    const auto of_first = fingerprint({&first, 1});
    EXPECT_NE(without, of_first);
    EXPECT_NE(of_first, fingerprint({&second, 1}));
}

// Paths see a matte surface of its colour: a box with a measured wall is as one with a matte
// wall of that albedo.
TEST_F(MeasuredBake, OthersSeeItsMeanColour) {
    const Imath::V3f albedo(0.6F, 0.3F, 0.1F);
    const auto flat = test::merl_file([&](const Imath::V3f&, const Imath::V3f&) {
        return albedo / static_cast<float>(M_PI);
    });
    const MeasuredBrdf measured = read_measured_brdf("m=" + file_of(flat).string());
    EXPECT_LT((albedo_of(measured.brdf) - albedo).length(), 0.02F);
    const scene::Scene scene = plane_of({.name = "m", .metallic = 1});
    const scene::Scene seen = scene_with_albedos(scene, {&measured, 1});
    EXPECT_EQ(seen.materials[0].name, "m");
    EXPECT_EQ(seen.materials[0].model, scene::BsdfModel::lambert);
    EXPECT_EQ(seen.materials[0].base_colour, albedo_of(measured.brdf));
    EXPECT_EQ(seen.meshes[0].positions, scene.meshes[0].positions);
}

template <typename Error, typename Act>
std::string refusal(Act act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "was accepted";
    return {};
}

TEST_F(MeasuredBake, RefusesWhatItCannotTakeByName) {
    const std::vector<std::byte> good = test::merl_file(satin_brdf);
    const std::string path = file_of(good).string();
    for (const std::string& words : std::vector<std::string>{"coat", "=" + path, "coat=", ""}) {
        const auto told =
            refusal<program::UsageError>([&] { (void)read_measured_brdf(words); });
        EXPECT_NE(told.find("expected MATERIAL=FILE"), std::string::npos) << told;
    }
    BakeParameters parameters = parameters_of_mesh();
    MeasuredBrdf measured = read_measured_brdf("caot=" + path);
    const scene::Scene scene = plane_of({.name = "coat"});
    const auto bake_it = [&] { bake(scene, parameters, directory_, {}, {&measured, 1}); };
    std::string told = refusal<program::UsageError>(bake_it);
    EXPECT_NE(told.find("'caot'"), std::string::npos) << told;
    EXPECT_NE(told.find("did you mean coat?"), std::string::npos) << told;
    EXPECT_FALSE(fs::exists(directory_ / "manifest.json"));

    measured.material = "coat";
    parameters.receivers = ReceiverKind::pixels;
    told = refusal<program::UsageError>(bake_it);
    EXPECT_NE(told.find("vertices"), std::string::npos) << told;

    std::vector<std::byte> bad = good;
    bad.resize(bad.size() - 8);
    told = refusal<factors::FactorError>(
        [&] { (void)read_measured_brdf("coat=" + file_of(bad).string()); });
    EXPECT_NE(told.find("satin.binary: 34992004 bytes, expected 34992012"), std::string::npos)
        << told;
    bad = good;
    bad[0] = std::byte{91};
    told = refusal<factors::FactorError>(
        [&] { (void)read_measured_brdf("coat=" + file_of(bad).string()); });
    EXPECT_NE(told.find("91×90×180 cells, expected 90×90×180"), std::string::npos) << told;
    bad.push_back(std::byte{0});
    told = refusal<files::FileError>(
        [&] { (void)read_measured_brdf("coat=" + file_of(bad).string()); });
    EXPECT_NE(told.find("satin.binary"), std::string::npos) << told;
    told = refusal<files::FileError>([] { (void)read_measured_brdf("coat=/none.binary"); });
    EXPECT_NE(told.find("/none.binary"), std::string::npos) << told;
}

}  // namespace
}  // namespace relume::bake
