// All edited materials of a room: what is whole depends on light and edits alone, and until
// then the layer says how far it is from there.
#include "server/materials/material_layer.h"

#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_materials.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <vector>

namespace relume::materials {
namespace {

constexpr double kAsLongAsItTakes = 1e9;
constexpr std::uint32_t kTiles = 6;  // of 40×24 pixels
constexpr std::size_t kTileFloats = std::size_t{3} * 256;

light::LightCubemap random_light(std::uint64_t seed) {
    light::LightCubemap light(8);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> value(0.5F, 1.5F);
    for (float& radiance : light.radiance) {
        radiance = value(random);
    }
    return light;
}

class MaterialLayerTest : public testing::Test {
  protected:
    MaterialLayerTest() {
        const auto path = folder_.path() / "tiny.relume";
        test::write_tiny_transport(path);
        test::add_random_materials(path);
        points_ = std::make_shared<const EditablePoints>(transport::Transport::open(path));
        layer_.emplace(points_, kUsualMaterialBytes);
        layer_->set_light(random_light(1));
    }

    // A material whose curve is this many times as high.
    [[nodiscard]] ShownMaterial scaled(std::size_t material,
                                       std::size_t curve,
                                       float factor) const {
        const curve::CurveBrdf& brdf = points_->materials()[material].brdf;
        curve::Curve changed = brdf.curves()[curve].curve;
        for (auto& channel : changed.rgb) {
            for (float& sample : channel) {
                sample *= factor;
            }
        }
        return {
            .material = material, .brdf = brdf.with_curve(curve, changed), .taken_up = curve};
    }
    static std::vector<float> shown(const MaterialLayer& layer) {
        std::vector<float> rgb(kTiles * kTileFloats, 1);
        for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
            layer.add_to_tile(tile, &rgb[tile * kTileFloats], std::size_t{3} * 16);
        }
        return rgb;
    }
    [[nodiscard]] std::vector<float> shown() const { return shown(*layer_); }
    [[nodiscard]] std::vector<float> shown_by_a_fresh_layer(
        std::uint64_t light, const std::vector<ShownMaterial>& materials) const {
        MaterialLayer fresh(points_, kUsualMaterialBytes);
        fresh.set_light(random_light(light));
        fresh.set_shown(materials);
        fresh.advance(kAsLongAsItTakes);
        EXPECT_TRUE(fresh.is_whole());
        return shown(fresh);
    }
    static double distance(const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            sum += (double{a[i]} - double{b[i]}) * (double{a[i]} - double{b[i]});
        }
        return std::sqrt(sum);
    }
    // One batch of work.
    void work_a_little() { layer_->advance(0); }

    test::ScratchDirectory folder_;
    std::shared_ptr<const EditablePoints> points_;
    std::optional<MaterialLayer> layer_;
};

TEST_F(MaterialLayerTest, WithoutAnEditNothingIsAddedAndNothingIsLeftToDo) {
    EXPECT_TRUE(layer_->is_whole());
    EXPECT_FALSE(layer_->has_work());
    EXPECT_EQ(layer_->error(), 0);
    EXPECT_EQ(shown(), std::vector<float>(kTiles * kTileFloats, 1));
}

TEST_F(MaterialLayerTest, WhatIsWholeDependsOnLightAndEditsAlone) {
    layer_->set_shown({scaled(0, 0, 3)});
    work_a_little();
    layer_->set_shown({scaled(0, 1, 0.5F), scaled(1, 1, 4)});
    layer_->advance(kAsLongAsItTakes);
    layer_->set_light(random_light(2));
    work_a_little();
    work_a_little();
    layer_->set_light(random_light(3));
    layer_->set_shown({scaled(1, 0, 2)});
    layer_->advance(kAsLongAsItTakes);
    EXPECT_TRUE(layer_->is_whole());
    EXPECT_FALSE(layer_->has_work());
    EXPECT_EQ(layer_->tiles_to_come(), 0U);
    EXPECT_EQ(shown(), shown_by_a_fresh_layer(3, {scaled(1, 0, 2)}));
    layer_->set_shown({});
    layer_->advance(kAsLongAsItTakes);
    EXPECT_EQ(shown(), std::vector<float>(kTiles * kTileFloats, 1));
}

TEST_F(MaterialLayerTest, ACurveTakenUpAgainNeedsNoNewColumns) {
    layer_->set_shown({scaled(0, 0, 3)});
    layer_->advance(kAsLongAsItTakes);
    const std::vector<float> before = shown();
    layer_->set_shown({scaled(0, 1, 3)});
    layer_->advance(kAsLongAsItTakes);
    layer_->set_shown({scaled(0, 0, 2)});
    work_a_little();  // multiplies what is there
    EXPECT_TRUE(layer_->is_whole());
    EXPECT_EQ(shown(), shown_by_a_fresh_layer(1, {scaled(0, 0, 2)}));
    EXPECT_NE(shown(), before);
}

TEST_F(MaterialLayerTest, ADraggedCurveIsWholeAtOnce) {
    layer_->set_shown({scaled(1, 0, 3)});
    layer_->advance(kAsLongAsItTakes);
    for (const float factor : {0.0F, 0.1F, 7.0F}) {
        layer_->set_shown({scaled(1, 0, factor)});
        EXPECT_FALSE(layer_->is_whole());
        EXPECT_TRUE(layer_->awaits_first_look());
        EXPECT_TRUE(layer_->advance(0));
        EXPECT_TRUE(layer_->is_whole());
        EXPECT_FALSE(layer_->awaits_first_look());
        EXPECT_EQ(shown(), shown_by_a_fresh_layer(1, {scaled(1, 0, factor)}));
    }
}

// Under a new light the errors that were learned before say how far the image is off.
TEST_F(MaterialLayerTest, StatesHowFarItIsFromTheWhole) {
    const std::vector<ShownMaterial> edited{scaled(0, 0, 3), scaled(1, 1, 9)};
    layer_->set_shown(edited);
    EXPECT_TRUE(layer_->awaits_first_look());
    layer_->advance(kAsLongAsItTakes);
    EXPECT_EQ(layer_->error(), 0);
    for (std::uint64_t light = 4; light < 8; ++light) {
        layer_->set_light(random_light(light));
        const std::vector<float> whole = shown_by_a_fresh_layer(light, edited);
        int stated = 0;
        while (layer_->has_work()) {
            work_a_little();
            if (layer_->awaits_first_look() || layer_->tiles_to_come() < kTiles) {
                continue;
            }
            const double truth = distance(shown(), whole);
            if (layer_->error() < 0.9 * distance(whole, std::vector<float>(whole.size(), 1))) {
                EXPECT_GT(layer_->error(), 0.4 * truth);
                EXPECT_LT(layer_->error(), 2.5 * truth);
                ++stated;
            }
        }
        EXPECT_GT(stated, 0);
        EXPECT_EQ(layer_->error(), 0);
        EXPECT_EQ(shown(), whole);
    }
}

TEST_F(MaterialLayerTest, ColumnsThatDoNotFitAreNotMade) {
    MaterialLayer small(points_, 1);
    small.set_light(random_light(1));
    small.set_shown({scaled(0, 0, 3)});
    small.advance(kAsLongAsItTakes);
    EXPECT_FALSE(small.has_work());
    EXPECT_FALSE(small.is_whole());
    EXPECT_GT(small.error(), 0);
    EXPECT_LT(small.bytes(), std::size_t{1} << 16) << "a glance at each tile";
    const std::vector<float> whole = shown_by_a_fresh_layer(1, {scaled(0, 0, 3)});
    EXPECT_LT(distance(shown(small), whole),
              0.5 * distance(whole, std::vector<float>(whole.size(), 1)));
}

TEST_F(MaterialLayerTest, ColumnsOfOtherCurvesGoWhereThereIsNoRoom) {
    layer_->set_shown({scaled(0, 0, 3)});
    layer_->advance(kAsLongAsItTakes);
    const std::size_t one = layer_->bytes();
    MaterialLayer tight(points_, one + one / 2);
    tight.set_light(random_light(1));
    for (const std::size_t curve : {0U, 1U, 0U, 1U}) {
        tight.set_shown({scaled(0, curve, 3)});
        tight.advance(kAsLongAsItTakes);
        EXPECT_TRUE(tight.is_whole());
        EXPECT_LE(tight.bytes(), one + one / 2);
    }
}

}  // namespace
}  // namespace relume::materials
