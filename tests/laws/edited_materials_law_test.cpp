// Light and materials are edited in one room: T·L and what is added where a material is edited
// equal an estimator that samples the light with the BRDF as edited, under any light.
#include "precompute/bake/bake.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "server/materials/material_layer.h"
#include "tests/laws/bake_estimate.h"
#include "tests/laws/curve_reference.h"
#include "tests/laws/law_light.h"
#include "tests/support/reference_tracer/random.h"
#include "tests/support/reference_tracer/sky.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace relume::test {
namespace {

using curve::Curve;
using materials::EditablePoints;
using materials::ShownMaterial;

constexpr std::uint32_t kSide = 32;
constexpr std::uint32_t kTexels = 32;     // along a face of the light
constexpr std::uint32_t kSamples = 4096;  // of the reference
constexpr double kForever = 1e9;

using Image = std::vector<Imath::V3d>;  // kSide² pixels
using Texels = std::vector<Imath::V3f>;

bake::BakeParameters law_parameters(std::uint32_t bounces) {
    bake::BakeParameters parameters = unbiased_parameters();
    parameters.width = parameters.height = kSide;
    parameters.face_resolution = kTexels;
    parameters.bounces = bounces;
    parameters.samples = 64;
    parameters.target_error = 1e-4F;
    return parameters;
}

// Where the sun of the first light has set, and the ground is bright.
Imath::V3d light_from_below(const Imath::V3d& direction) {
    return sun_and_gradient(Imath::V3d(direction.z, -direction.y, direction.x)) *
           Imath::V3d(0.7, 1, 1.3);
}

// A bake whose materials are edited, opened as a server has it.
class LitRoom {
  public:
    LitRoom(const scene::Scene& scene, std::uint32_t bounces) {
        const auto path = folder_.path() / "lit.relume";
        bake::bake(scene, law_parameters(bounces), path, {}, {},
                   {.editable = {"pearl", "post", "cloth"}, .resolution = {}});
        transport_ = transport::Transport::open(path);
        points_ = std::make_shared<const EditablePoints>(transport_);
    }

    [[nodiscard]] const EditablePoints& points() const { return *points_; }

    [[nodiscard]] Image image(const Texels& texels,
                              const std::vector<ShownMaterial>& shown) const {
        bake::CubemapLight planes;
        light::LightCubemap cubemap(kTexels);
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t i = 0; i < texels.size(); ++i) {
                planes[c].push_back(texels[i][static_cast<int>(c)]);
                cubemap.planes()[c][i] = planes[c].back();
            }
        }
        const bake::DenseImage relit = bake::relight(*transport_, planes);
        std::vector<float> added(std::size_t{3} * kSide * kSide, 0);
        materials::MaterialLayer layer(points_, materials::kUsualMaterialBytes);
        layer.set_light(cubemap);
        layer.set_shown(shown);
        layer.advance(kForever);
        EXPECT_TRUE(layer.is_whole());
        const transport::TileGrid& grid = points_->image();
        for (std::uint32_t tile = 0; tile < grid.block_count(); ++tile) {
            const std::size_t x = tile % grid.tiles_x() * transport::kTileSide;
            const std::size_t y = tile / grid.tiles_x() * transport::kTileSide;
            layer.add_to_tile(tile, &added[3 * (y * kSide + x)], std::size_t{3} * kSide);
        }
        Image image(std::size_t{kSide} * kSide);
        for (std::size_t i = 0; i < image.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                image[i][static_cast<int>(c)] = relit.rgb[c][i] + double{added[3 * i + c]};
            }
        }
        return image;
    }

  private:
    ScratchDirectory folder_;
    std::shared_ptr<const transport::Transport> transport_;
    std::shared_ptr<const EditablePoints> points_;
};

// Curves by material and index, with what becomes of each.
struct CurveEdit {
    std::string material;
    std::string curve;
    float power = 1;  // of the curve's values
    float factor = 1;
};

Curve edited_curve(Curve curve, const CurveEdit& edit) {
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
            float& value = curve.rgb[c][k];
            // Waves along the curve, of another phase in each colour.
            const float wave = 1 + 0.8F * std::sin(0.1F * static_cast<float>(k) +
                                                   2.0F * static_cast<float>(c));
            value = edit.factor * wave * std::pow(value, edit.power);
        }
    }
    return curve;
}

struct EditedScene {
    std::vector<ShownMaterial> shown;
    std::map<std::uint32_t, curve::CurveBrdf> brdfs;  // by the scene's material
};

EditedScene edit(const scene::Scene& scene,
                 const EditablePoints& points,
                 const std::vector<CurveEdit>& edits) {
    EditedScene edited;
    for (std::size_t m = 0; m < points.materials().size(); ++m) {
        const materials::EditableMaterial& material = points.materials()[m];
        ShownMaterial shown{.material = m, .brdf = material.brdf};
        bool is_edited = false;
        for (const CurveEdit& edit : edits) {
            if (edit.material != material.id) {
                continue;
            }
            is_edited = true;
            shown.taken_up = shown.brdf.index_of(std::string_view(edit.curve));
            shown.brdf = shown.brdf.with_curve(
                shown.taken_up, edited_curve(shown.brdf.curves()[shown.taken_up].curve, edit));
        }
        if (!is_edited) {
            continue;
        }
        for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
            if (scene.materials[i].name == material.id) {
                edited.brdfs.emplace(i, shown.brdf);
            }
        }
        edited.shown.push_back(std::move(shown));
    }
    return edited;
}

Image reference_image(const scene::Scene& scene,
                      const Texels& texels,
                      const std::map<std::uint32_t, curve::CurveBrdf>& brdfs,
                      std::uint32_t bounces) {
    return reflect_with_curves(scene, reference::Sky::from_cubemap(kTexels, texels), brdfs,
                               {.side = kSide, .samples = kSamples, .bounces = bounces})
        .mean;
}

Image sum(const Image& a, const Image& b, double factor) {
    Image image = a;
    for (std::size_t i = 0; i < image.size(); ++i) {
        image[i] += b[i] * factor;
    }
    return image;
}

// Of what an edit changes: the bake's own noise is in both images of the room.
double error_of_change(const Image& edited,
                       const Image& baked,
                       const Image& edited_truth,
                       const Image& baked_truth) {
    return relative_l2(sum(edited, baked, -1), sum(edited_truth, baked_truth, -1));
}

const std::vector<std::vector<CurveEdit>>& edit_sets() {
    static const std::vector<std::vector<CurveEdit>> sets{
        {{.material = "pearl", .curve = "distribution", .factor = 6}},
        {{.material = "post", .curve = "fresnel", .factor = 0.4F}},
        {{.material = "cloth", .curve = "distribution", .power = 0.5F, .factor = 2}},
        {{.material = "pearl", .curve = "fresnel", .factor = 3},
         {.material = "pearl", .curve = "distribution", .factor = 0.5F},
         {.material = "post", .curve = "distribution", .power = 0.7F},
         {.material = "cloth", .curve = "fresnel", .factor = 2}}};
    return sets;
}

TEST(EditedMaterialsLaw, AnEditUnderAnyLightShowsWhatItsBrdfReflects) {
    const scene::Scene scene = scene::build_builtin_scene("earrings");
    const LitRoom room(scene, 0);
    for (const auto& light : {sun_and_gradient, light_from_below}) {
        const Texels texels = cubemap_from_function(kTexels, light);
        const Image baked = room.image(texels, {});
        const Image baked_truth = reference_image(scene, texels, {}, 0);
        std::cout << "  as baked: " << relative_l2(baked, baked_truth) << '\n';
        EXPECT_LT(relative_l2(baked, baked_truth), 0.03);
        for (const auto& edits : edit_sets()) {
            const EditedScene edited = edit(scene, room.points(), edits);
            const Image image = room.image(texels, edited.shown);
            const Image truth = reference_image(scene, texels, edited.brdfs, 0);
            const double of_change = error_of_change(image, baked, truth, baked_truth);
            std::cout << "  " << edits.front().material << "." << edits.front().curve << ": "
                      << relative_l2(image, truth) << ", of the change " << of_change
                      << ", which is " << relative_l2(baked_truth, truth) << '\n';
            EXPECT_GT(relative_l2(baked_truth, truth), 0.02) << "the edit is not to be seen";
            EXPECT_LT(relative_l2(image, truth), 0.04);
            EXPECT_LT(of_change, 0.1);
        }
    }
}

// Light that comes by way of other surfaces meets materials as they were baked.
TEST(EditedMaterialsLaw, InterreflectionStaysThatOfTheMaterialsAsBaked) {
    const scene::Scene scene = scene::build_builtin_scene("earrings");
    const LitRoom room(scene, 2);
    const Texels texels = cubemap_from_function(kTexels, sun_and_gradient);
    const EditedScene edited = edit(scene, room.points(), edit_sets().back());
    const double error = error_of_change(
        room.image(texels, edited.shown), room.image(texels, {}),
        reference_image(scene, texels, edited.brdfs, 0), reference_image(scene, texels, {}, 0));
    std::cout << "  of the change " << error << '\n';
    EXPECT_LT(error, 0.1);
}

}  // namespace
}  // namespace relume::test
