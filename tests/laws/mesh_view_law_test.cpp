// The view that a server draws of a surface is the one that rays see, from wherever it is
// looked at: another way to find what shows, and the sum of the terms as it is written down.
#include "precompute/bake/bake.h"
#include "precompute/bake/mesh/surface_image.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/transport/transport.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"
#include "tests/laws/law_light.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

namespace relume::test {
namespace {

constexpr std::uint32_t kFaceResolution = 8;
constexpr int kViews = 20;

bake::CubemapLight law_light() {
    const auto texels = cubemap_from_function(kFaceResolution, sun_and_gradient);
    bake::CubemapLight light;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const Imath::V3f& texel : texels) {
            light[c].push_back(texel[static_cast<int>(c)]);
        }
    }
    return light;
}

// A sheet with round holes, in front of everything else.
void add_sheet(scene::Scene& scene) {
    constexpr std::uint32_t kTexels = 8;
    std::vector<half> rgba;
    for (std::uint32_t i = 0; i < kTexels * kTexels; ++i) {
        const std::uint32_t x = i % kTexels % 4;
        const std::uint32_t y = i / kTexels % 4;
        const bool is_hole = (x == 1 || x == 2) && (y == 1 || y == 2);
        rgba.insert(rgba.end(), {half(0.9F), half(0.7F), half(0.2F), half(is_hole ? 0 : 1)});
    }
    scene.textures.emplace_back("holes", kTexels, kTexels, std::move(rgba));
    scene.materials.push_back({.name = "sheet",
                               .base_colour = {1, 1, 1},
                               .alpha_cutoff = 0.5F,
                               .base_texture = scene::TextureUse(0)});
    scene::Mesh sheet;
    sheet.name = "sheet";
    sheet.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    const Imath::Box3f bounds = scene.bounds();
    const Imath::V3f middle = bounds.center();
    const float side = 0.2F * bounds.size().x;
    for (const auto& [x, y] : {std::pair{-1.0F, -1.0F}, {1, -1}, {1, 1}, {-1, 1}}) {
        sheet.positions.emplace_back(middle.x + side * x, middle.y + side * y,
                                     bounds.max.z - 0.1F * bounds.size().z);
        sheet.uvs.emplace_back(x, y);
    }
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(std::move(sheet));
    scene::finish_scene(scene);
}

// A box whose white surfaces are satin, behind a sheet with holes, baked for cameras that move.
class MeshViewLaw : public testing::Test {
  protected:
    MeshViewLaw() {
        scene::Scene scene = scene::build_builtin_scene("box");
        scene.materials[0] = {.name = "satin",
                              .model = scene::BsdfModel::phong,
                              .base_colour = {0.5F, 0.5F, 0.5F},
                              .specular = {0.3F, 0.25F, 0.2F},
                              .exponent = 8};
        add_sheet(scene);
        bake::BakeParameters parameters;
        parameters.receivers = bake::ReceiverKind::vertices;
        parameters.width = 72;
        parameters.height = 48;
        parameters.face_resolution = kFaceResolution;
        parameters.bounces = 1;
        parameters.samples = 16;
        parameters.vertices = 1500;
        parameters.terms = 4;
        bake::bake(scene, parameters, scratch_.path() / "box.relume");
        scene_ = std::make_shared<const served::Scene>(
            transport::Transport::open(scratch_.path() / "box.relume"));
    }

    // Exact sums under the light.
    [[nodiscard]] engine::Session lit(const bake::CubemapLight& light) const {
        engine::Session session(scene_->workspace(), relighting::Strategy{});
        const std::size_t columns = scene_->columns().count();
        std::vector<float> coefficients(3 * columns);
        for (std::size_t c = 0; c < 3; ++c) {
            scene_->projection().project_radiance(
                light[c], std::span(coefficients).subspan(c * columns, columns));
        }
        session.set_target(coefficients);
        while (!session.exact()) {
            session.advance({.milliseconds = 100, .coefficients = {}, .target_error = 0});
        }
        return session;
    }

    test::ScratchDirectory scratch_;
    std::shared_ptr<const served::Scene> scene_;
};

TEST_F(MeshViewLaw, TheServerDrawsWhatRaysSee) {
    const bake::CubemapLight light = law_light();
    const engine::Session session = lit(light);
    const std::vector<double> values = bake::relit_receivers(scene_->transport(), light);
    const std::unique_ptr<view::View> view = scene_->make_view();
    std::size_t pixels = 0;
    std::size_t other = 0;
    double difference = 0;
    double norm = 0;
    for (int i = 0; i < kViews; ++i) {
        view::Look look = scene_->beginning();
        const Imath::V3d arm = look.eye - look.look_at;
        const double angle = 0.35 * (i - kViews / 2) / kViews;
        look.eye = look.look_at + Imath::V3d(arm.x * std::cos(angle) + arm.z * std::sin(angle),
                                             arm.y + 0.2 * arm.length() * std::sin(3.0 * i),
                                             arm.z * std::cos(angle) - arm.x * std::sin(angle));
        look.fov_degrees = 25 + 2 * i;
        view->look(look);
        const transport::TileGrid& size = view->image();
        std::vector<float> drawn(std::size_t{3} * size.width * size.height);
        view->sums_have_changed();
        view::write_image(*view, session.sums(), drawn);
        const bake::SurfaceImage seen =
            bake::view_surface(scene_->transport(), values, view->camera(), size, 1);
        for (std::size_t pixel = 0; pixel < seen.rgb.size(); ++pixel) {
            const Imath::V3d of_pixel(drawn[3 * pixel], drawn[3 * pixel + 1],
                                      drawn[3 * pixel + 2]);
            const double apart = (of_pixel - seen.rgb[pixel]).length2();
            ++pixels;
            // Where a middle lies on an edge to the last bit, the two may see either side.
            if (apart > 1e-4 * seen.rgb[pixel].length2() + 1e-10) {
                ++other;
                continue;
            }
            difference += apart;
            norm += seen.rgb[pixel].length2();
        }
    }
    std::cout << "  " << other << " of " << pixels
              << " pixels are of other points; of the rest "
              << "the relative L2 is " << std::sqrt(difference / norm) << '\n';
    EXPECT_GT(norm, 0);
    EXPECT_LT(static_cast<double>(other), 2e-3 * static_cast<double>(pixels));
    EXPECT_LT(std::sqrt(difference / norm), 1e-4);
}

}  // namespace
}  // namespace relume::test
