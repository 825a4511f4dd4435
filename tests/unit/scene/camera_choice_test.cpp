// Which camera of a file is taken, and where the scene lies in front of it.
#include "precompute/scene/camera_choice.h"

#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/case_probe.h"
#include "tests/unit/scene/gltf_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {
namespace {

using nlohmann::json;
using test::mentions;

void expect_near(const Imath::V3d& a, const Imath::V3d& b) {
    EXPECT_LT((a - b).length(), 1e-5) << a << " and " << b;
}

class CameraChoice : public testing::Test {
  protected:
    Scene import(const json& document, const CameraRequest& request = {}, double aspect = 1) {
        test::write_json(scratch_.path() / "scene.gltf", document);
        ImportOptions options;
        options.camera = request;
        options.aspect = aspect;
        return import_scene(scratch_.path() / "scene.gltf", options);
    }
    std::string refusal(const json& document, const std::string& wanted) {
        try {
            (void)import(document, {.wanted = wanted});
        } catch (const SceneError& error) {
            EXPECT_EQ(error.fault(), SceneFault::unknown_name);
            return error.what();
        }
        ADD_FAILURE() << "'" << wanted << "' was found";
        return "";
    }
    // `eye` at z = 5 and `side` at x = 9, twice `twin` at x = 7 and 8, and `2` at y = 4.
    static json five_cameras() {
        json document = test::gltf_triangle();
        const auto add = [&](const char* name, double x, double y) {
            document["nodes"].push_back(
                {{"name", name}, {"camera", 0}, {"translation", {x, y, 0}}});
            document["scenes"][0]["nodes"].push_back(document["nodes"].size() - 1);
        };
        add("side", 9, 0);
        add("twin", 7, 0);
        add("twin", 8, 0);
        add("2", 0, 4);
        return document;
    }
    static json without_camera(const json& whole) {
        json document = whole;
        document.erase("cameras");
        document["nodes"][1].erase("camera");
        return document;
    }
    test::ScratchDirectory scratch_;
};

TEST_F(CameraChoice, ByNameIndexAndPath) {
    const json document = five_cameras();
    expect_near(import(document).frame.origin, {0, 0, 5});
    expect_near(import(document, {.wanted = "side"}).frame.origin, {9, 0, 0});
    expect_near(import(document, {.wanted = "3"}).frame.origin, {8, 0, 0});
    // A name counts before a number.
    expect_near(import(document, {.wanted = "2"}).frame.origin, {0, 4, 0});
}

TEST_F(CameraChoice, ManyAndNoneAreRefusedWithTheList) {
    for (const char* wanted : {"twin", "nobody", "17", "-1"}) {
        const std::string why = refusal(five_cameras(), wanted);
        for (const char* there : {"0: eye", "1: side", "2: twin", "3: twin", "4: 2"})
            EXPECT_NE(why.find(there), std::string::npos) << why;
    }
    EXPECT_NE(refusal(without_camera(test::gltf_triangle()), "eye").find("none"),
              std::string::npos);
}

TEST_F(CameraChoice, ListNamesThemInTheFilesOrder) {
    test::write_json(scratch_.path() / "scene.gltf", five_cameras());
    const std::vector<std::string> lines = list_of(cameras_in(scratch_.path() / "scene.gltf"));
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[1].rfind("1: side", 0), 0U) << lines[1];
}

TEST_F(CameraChoice, PartsGivenByHandReplaceTheFiles) {
    const json document = five_cameras();
    const Scene moved = import(document, {.eye = Imath::V3d(1, 2, 3)});
    expect_near(moved.frame.origin, {1, 2, 3});
    expect_near(Imath::V3d(moved.camera.look_at), {0, 0, -1});
    const Scene turned = import(document, {.look_at = Imath::V3d(0, 0, 9)});
    expect_near(turned.frame.origin, {0, 0, 5});
    expect_near(Imath::V3d(turned.camera.look_at), {0, 0, 1});
    EXPECT_THROW(
        (void)import(document, {.eye = Imath::V3d(1, 1, 1), .look_at = Imath::V3d(1, 1, 1)}),
        SceneError);
}

// Every vertex lies inside the image, and the scene fills a good part of it.
TEST_F(CameraChoice, AFileWithoutCamerasIsFramed) {
    const json document = without_camera(test::gltf_triangle());
    for (const double aspect : {0.25, 1.0, 3.0}) {
        const Scene scene = import(document, {}, aspect);
        EXPECT_TRUE(mentions(scene.report.repairs, "--eye=")) << aspect;
        const Camera camera(scene.camera, static_cast<std::uint32_t>(400 * aspect), 400);
        float widest = 0;
        for (const Imath::V3f& position : scene.meshes[0].positions) {
            const Imath::V3f to = position - camera.eye();
            const float depth = to.dot(camera.forward());
            ASSERT_GT(depth, 0);
            const float x = to.dot(camera.right()) / depth / camera.tan_half_width();
            const float y = to.dot(camera.up()) / depth / camera.tan_half_height();
            EXPECT_LE(std::max(std::abs(x), std::abs(y)), 1) << aspect;
            widest = std::max({widest, std::abs(x), std::abs(y)});
        }
        EXPECT_GT(widest, 0.5F) << aspect;
    }
}

TEST_F(CameraChoice, AnOrthographicCameraIsNamedAndTheSceneFramed) {
    json document = test::gltf_triangle();
    document["cameras"][0] = {
        {"type", "orthographic"},
        {"orthographic", {{"xmag", 2}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 10}}}};
    const Scene scene = import(document);
    EXPECT_TRUE(mentions(scene.report.unused, "orthographic"));
    EXPECT_TRUE(mentions(scene.report.repairs, "frames the scene"));
}

TEST_F(CameraChoice, ZUpTurnsSceneAndCameraTogether) {
    test::write_json(scratch_.path() / "scene.gltf", test::gltf_triangle());
    ImportOptions options;
    const Scene upright = import_scene(scratch_.path() / "scene.gltf", options);
    options.up_axis = UpAxis::z;
    const Scene turned = import_scene(scratch_.path() / "scene.gltf", options);
    // What lay along +Z lies along +Y.
    expect_near(turned.frame.origin, {0, 5, 0});
    expect_near(Imath::V3d(turned.camera.look_at), {0, -1, 0});
    const Camera before(upright.camera, 10, 10);
    const Camera after(turned.camera, 10, 10);
    for (std::size_t i = 0; i < 3; ++i) {
        const Imath::V3f& p = upright.meshes[0].positions[i];
        const Imath::V3f& q = turned.meshes[0].positions[i];
        for (const auto axis : {&Camera::right, &Camera::up, &Camera::forward})
            EXPECT_NEAR(p.dot((before.*axis)()), q.dot((after.*axis)()), 1e-6F);
    }
}

// The picture's geometry is the same numbers wherever the scene stands, whatever its size.
TEST_F(CameraChoice, FarAndLargeScenesHaveTheSameFloats) {
    const json near_document = test::gltf_triangle();
    const Scene near_scene = import(near_document);
    for (const double far : {1e5, 1e6, 1e7}) {
        json document = near_document;
        document["nodes"][0]["translation"] = {far, -far, 0.5 * far};
        document["nodes"][1]["translation"] = {far, -far, 0.5 * far + 5};
        const Scene scene = import(document);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LT(
                (scene.meshes[0].positions[i] - near_scene.meshes[0].positions[i]).length(),
                1e-6F)
                << far;
        EXPECT_FALSE(mentions(scene.report.repairs, "numbers step")) << far;
    }
    for (const int power : {-20, 20}) {
        const double size = std::ldexp(1.0, power);
        json document = near_document;
        document["nodes"][0]["scale"] = {size, size, size};
        document["nodes"][1]["translation"] = {0, 0, 5 * size};
        const Scene scene = import(document);
        EXPECT_EQ(scene.meshes[0].positions, near_scene.meshes[0].positions) << power;
    }
}

}  // namespace
}  // namespace relume::scene
