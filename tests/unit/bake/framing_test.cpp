// Where a scene stands, how large it is and what is up in its file change no picture; and what
// an image will show is known before it is baked.
#include "precompute/bake/framing.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/base/error.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/import.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/bake/relit_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace relume::bake {
namespace {

constexpr std::uint32_t kN = 8;

std::filesystem::path case_path(const std::string& name) {
    return std::filesystem::path(RELUME_SCENE_CASES) / name;
}

class Framing : public testing::Test {
  protected:
    static BakeParameters parameters() {
        return {.width = 24,
                .height = 24,
                .face_resolution = kN,
                .bounces = 1,
                .samples = 16,
                .pixel_samples = 4};
    }
    DenseImage image_of(const scene::Scene& scene, const CubemapLight& light) {
        const auto path = scratch_.path() / std::to_string(count_++);
        bake(scene, parameters(), path);
        return relight(*transport::Transport::open(path), light);
    }
    // Brighter above and to the right, so that turns show.
    static CubemapLight slanted_light() {
        return light_from(kN, [](const Imath::V3f& d) {
            return 1.0F + 0.8F * d.y + 0.5F * d.x + (d.x > 0.5F && d.y > 0.5F ? 4.0F : 0.0F);
        });
    }
    // A roof above a floor, as text: every number a double's. `place`: p ↦ offset + size·p.
    scene::Scene hut(double offset, double size, bool as_ply) {
        const double corners[8][3] = {{-3, 0, -3}, {3, 0, -3},   {3, 0, 3},   {-3, 0, 3},
                                      {-1, 1, -1}, {1, 1.5, -1}, {1, 1.5, 1}, {-1, 1, 1}};
        const auto at = [&](double p) { return offset + size * p; };
        const auto path =
            scratch_.path() / (std::to_string(count_++) + (as_ply ? ".ply" : ".obj"));
        std::ofstream file(path);
        file.precision(17);
        if (as_ply) {
            file << "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty "
                    "double "
                    "y\nproperty double z\nelement face 2\nproperty list uchar int "
                    "vertex_indices\nend_header\n";
        }
        for (const auto& p : corners) {
            file << (as_ply ? "" : "v ") << at(p[0]) << ' ' << at(p[1]) << ' ' << at(p[2])
                 << '\n';
        }
        file << (as_ply ? "4 0 1 2 3\n4 4 5 6 7\n" : "f 1 2 3 4\nf 5 6 7 8\n");
        file.close();
        scene::ImportOptions options;
        options.camera = {.eye = Imath::V3d(at(2), at(2.5), at(5)),
                          .look_at = Imath::V3d(at(0), at(0.5), at(0))};
        return scene::import_scene(path, options);
    }

    test::ScratchDirectory scratch_;
    int count_ = 0;
};

TEST_F(Framing, GltfScenesFarAwayAndOfAnySizeGiveOnePicture) {
    const std::string folder = "12-far-origin-and-scale/";
    const CubemapLight light = slanted_light();
    const DenseImage reference =
        image_of(scene::import_scene(case_path(folder + "ref.gltf")), light);
    for (const char* file : {"far1e5_node", "scale_um", "scale_mm", "scale_10", "scale_3000",
                             "scale_1e4", "scale_100000"}) {
        const scene::Scene scene = scene::import_scene(case_path(folder + file + ".gltf"));
        EXPECT_LT(relative_l2(image_of(scene, light), reference), 1e-3) << file;
        const scene::Camera camera(scene.camera, 24, 24);
        const Imath::V3f forward(0, -std::sin(0.35F), -std::cos(0.35F));
        EXPECT_LT((camera.forward() - forward).length(), 1e-6F) << file;
    }
}

TEST_F(Framing, TextScenesFarAwayAndOfAnySizeGiveOnePicture) {
    const CubemapLight light = slanted_light();
    const DenseImage reference = image_of(hut(0, 1, false), light);
    for (const bool as_ply : {false, true}) {
        for (const double offset : {1e4, -1e6, 1e7}) {
            EXPECT_LT(relative_l2(image_of(hut(offset, 1, as_ply), light), reference), 1e-3)
                << offset << as_ply;
        }
        for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
            EXPECT_LT(relative_l2(image_of(hut(0, size, as_ply), light), reference), 1e-3)
                << size << as_ply;
        }
    }
}

TEST_F(Framing, NumbersTooCoarseForTheirSceneAreReported) {
    for (const char* file : {"far1e4", "far1e5", "far1e6", "far1e5_node", "ref", "scale_um"}) {
        const scene::Scene scene = scene::import_scene(
            case_path("12-far-origin-and-scale/" + std::string(file) + ".gltf"));
        const bool is_said =
            std::any_of(scene.report.repairs.begin(), scene.report.repairs.end(),
                        [](const std::string& line) {
                            return line.find("numbers step") != std::string::npos;
                        });
        EXPECT_EQ(is_said,
                  std::string(file).starts_with("far1e") && std::string(file) != "far1e5_node")
            << file;
    }
}

// A floor under a full upper sky shows its albedo, 0.5, whichever axis is up in its file.
TEST_F(Framing, ZUpTurnsTheScene) {
    scene::ImportOptions options;
    options.up_axis = scene::UpAxis::z;
    options.camera = {.eye = Imath::V3d(0, 0, 4), .look_at = Imath::V3d(0, 0, 0)};
    const scene::Scene scene = scene::import_scene(case_path("47-z-up/floor.ply"), options);
    const DenseImage image = image_of(
        scene, light_from(kN, [](const Imath::V3f& d) { return d.y > 0 ? 1.0F : 0.0F; }));
    for (const auto& plane : image.rgb) {
        EXPECT_NEAR(plane[12 * 24 + 12], 0.5, 0.01);
    }
}

TEST_F(Framing, AnImageOfNothingIsRefusedBeforeTheBake) {
    scene::ImportOptions options;
    options.camera = {.eye = Imath::V3d(0, 0, 4), .look_at = Imath::V3d(0, 0, 9)};
    const scene::Scene scene = scene::import_scene(case_path("47-z-up/floor.ply"), options);
    try {
        bake(scene, parameters(), scratch_.path() / "empty");
        ADD_FAILURE() << "baked";
    } catch (const BakeError& error) {
        const std::string why = error.what();
        for (const char* word :
             {"empty", "(-3, -3, 0)", "(3, 3, 0)", "(0, 0, 4)", "(0, 0, 1)"}) {
            EXPECT_NE(why.find(word), std::string::npos) << word << ": " << why;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "empty"));
}

TEST_F(Framing, PreviewIsAPictureAndNeedsAPngName) {
    const scene::Scene scene = scene::import_scene(case_path("47-z-up/floor.ply"));
    write_preview(scratch_.path() / "floor.png", scene, parameters());
    EXPECT_GT(std::filesystem::file_size(scratch_.path() / "floor.png"), 100U);
    EXPECT_THROW(write_preview(scratch_.path() / "floor.jpg", scene, parameters()), BakeError);
}

}  // namespace
}  // namespace relume::bake
