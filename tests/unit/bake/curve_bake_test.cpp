// A bake of curves from the words of its command line to the directory, and what it refuses.
#include "precompute/bake/bake.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/relight.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/basis/curve_basis.h"
#include "protocol/transport/transport.h"
#include "tests/support/merl_file.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

std::string fault_of(const CurveRequest& request) {
    static const scene::Scene scene = scene::build_builtin_scene("earrings");
    try {
        (void)edited_materials(scene, request);
    } catch (const program::UsageError& error) {
        return error.what();
    }
    return "none";
}

void expect_named(const CurveRequest& request, const std::string& named) {
    const std::string fault = fault_of(request);
    EXPECT_NE(fault.find(named), std::string::npos) << fault << " / " << named;
}

TEST(CurveRequest, NamesWhatIsWrong) {
    expect_named({.edits = {"perl"}}, "did you mean pearl");
    expect_named({.edits = {"perl.fresnel"}}, "did you mean pearl");
    expect_named({.edits = {"pearl", "pearl.fresnel"}}, "listed twice");
    expect_named({.edits = {"pearl.spread_u"}}, "distribution");
    expect_named({.edits = {"pedestal"}}, "--model pedestal=MODEL");
    expect_named({.edits = {"pearl"}, .models = {"post=ggx"}}, "not edited");
    expect_named({.edits = {"pearl"}, .models = {"pearl"}}, "MATERIAL=MODEL");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ggx", "pearl=phong"}}, "has two");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ward"}}, "no model 'ward'");
    expect_named({.edits = {"pearl"}, .models = {"pearl=measured"}}, "no model 'measured'");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ggx:alpa=0.2"}}, "alpha");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ggx:alpha=7"}}, "alpha");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ggx:alpha=wide"}}, "'wide'");
    expect_named({.edits = {"pearl"}, .models = {"pearl=ggx:f0=1/2"}}, "red/green/blue");
    EXPECT_EQ(fault_of({.edits = {"pearl", "post.fresnel", "pedestal"},
                        .models = {"pedestal=cook-torrance:sigma=0.3,n=0.2/0.4/1.3,e=3"}}),
              "none");
}

TEST(CurveRequest, TakesAtMostSixteenMaterialsAndGivesEachAnId) {
    scene::Scene scene = scene::build_builtin_scene("earrings");
    const scene::Material pearl = scene.materials[0];
    std::vector<std::string> names;
    for (int i = 0; i < 17; ++i) {
        scene.materials.push_back(pearl);
        scene.materials.back().name = "Mat. \xC3\xA9 " + std::to_string(i);
        names.push_back(scene.materials.back().name);
    }
    EXPECT_THROW((void)edited_materials(scene, {.edits = names}), program::UsageError);
    names.pop_back();
    const auto materials = edited_materials(scene, {.edits = names});
    ASSERT_EQ(materials.size(), 16U);
    EXPECT_EQ(materials[3].name, names[3]);
    EXPECT_EQ(materials[3].id, "Mat.----3");
}

TEST(FrozenLight, NamesWhatIsWrong) {
    EXPECT_THROW((void)frozen_light({.environment = "sky-nun"}, 8), program::UsageError);
    EXPECT_THROW((void)frozen_light({.environment = "sky-noon", .gain = -1}, 8),
                 program::UsageError);
    EXPECT_THROW((void)frozen_light({.environment = "sky-noon", .gain = std::nan("")}, 8),
                 program::UsageError);
}

class CurveBake : public testing::Test {
  protected:
    [[nodiscard]] CurveEdits edits(const CurveRequest& request) const {
        return {.light = frozen_light({.environment = "sky-noon"}, 8),
                .materials = edited_materials(scene_, request)};
    }

    scene::Scene scene_ = scene::build_builtin_scene("earrings");
    BakeParameters parameters_{.width = 40,
                               .height = 32,
                               .face_resolution = 8,
                               .bounces = 1,
                               .samples = 8,
                               .pixel_samples = 4};
    test::ScratchDirectory scratch_;
};

TEST_F(CurveBake, MakesATransportOfKindCurvesThatIsWhole) {
    const auto path = scratch_.path() / "e.relume";
    bake_curves(scene_, parameters_, edits({.edits = {"pearl", "cloth.fresnel"}}), path);
    EXPECT_TRUE(find_faults(path).empty());
    const auto transport = transport::Transport::open(path);
    const transport::Manifest& manifest = transport->manifest();
    EXPECT_EQ(manifest.kind, transport::Kind::curves);
    ASSERT_TRUE(manifest.curves);
    ASSERT_EQ(manifest.curves->curves.size(), 2U);
    EXPECT_EQ(manifest.curves->curves[1].curve, "fresnel");
    EXPECT_EQ(manifest.curves->curves[1].angle, "difference");
    EXPECT_EQ(transport->column_count(), basis::CurveBasis(2).coefficient_count());
    EXPECT_EQ(manifest.bake.at("interreflection"), "frozen");
    ASSERT_TRUE(manifest.sampling_error);
    EXPECT_GT(manifest.sampling_error->natural, 0);
    EXPECT_LT(manifest.sampling_error->natural, 0.2);
    const auto& quantisation = manifest.measured.at("quantisation_error");
    EXPECT_LT(quantisation.at("natural").at("relative_l2").get<double>(), 0.02);
    EXPECT_TRUE(std::filesystem::exists(path / "view" / "materials.png"));
    // Past the scene there is the sky, so that every pixel is covered and none is black.
    const DenseImage image = relight(*transport, coefficients_as_baked(*transport));
    for (std::size_t pixel = 0; pixel < image.coverage.size(); ++pixel) {
        EXPECT_EQ(image.coverage[pixel], 1);
        EXPECT_GT(image.rgb[1][pixel], 0);
    }
}

TEST_F(CurveBake, HasTheSameBytesOnAnyNumberOfThreads) {
    std::vector<std::uint64_t> sums;
    for (const std::uint32_t threads : {1U, 2U}) {
        parameters_.threads = threads;
        const auto path = scratch_.path() / std::to_string(threads);
        bake_curves(scene_, parameters_, edits({.edits = {"pearl"}}), path);
        const auto manifest = transport::read_manifest(path / "manifest.json");
        sums.push_back(manifest.shards.front().header_checksum);
    }
    EXPECT_EQ(sums[0], sums[1]);
}

// A measured BRDF that is a diffuse colour and a product of curves is found again.
TEST_F(CurveBake, TakesAMeasuredMaterialAsCurves) {
    const auto file = scratch_.path() / "cloth.binary";
    const curve::CurveBrdf velvet = curve::CurveBrdf::ggx({0.3F, 0.1F, 0.1F}, 0.8F, 0.4F);
    const std::vector<std::byte> bytes =
        test::merl_file([&](const Imath::V3f& wi, const Imath::V3f& wo) {
            return Imath::V3f(0.05F, 0.02F, 0.02F) + velvet.evaluate(wi, wo);
        });
    files::write_file_atomically(file, {bytes});
    const std::vector<MeasuredBrdf> measured{read_measured_brdf("cloth=" + file.string())};
    const CurveEdits of_cloth{
        .light = frozen_light({.environment = "sky-noon"}, 8),
        .materials = edited_materials(scene_, {.edits = {"cloth.fresnel"}}, measured)};
    ASSERT_EQ(of_cloth.materials.size(), 1U);
    EXPECT_EQ(of_cloth.materials[0].brdf.model(), curve::CurveModel::measured);
    EXPECT_TRUE(of_cloth.materials[0].albedo);
    const nlohmann::json& errors = of_cloth.materials[0].notes.at("errors");
    EXPECT_LT(errors.at("homomorphic").at("relative_l2").get<double>(), 0.1);
    const EditedMaterial by_nmf =
        edited_materials(scene_,
                         {.edits = {"cloth.fresnel"},
                          .models = {},
                          .factors = factors::CurveMethod::nonnegative},
                         measured)
            .front();
    EXPECT_EQ(by_nmf.notes.at("factors"), "nmf");
    EXPECT_EQ(by_nmf.notes.at("errors"), errors);
    EXPECT_NE(by_nmf.brdf, of_cloth.materials[0].brdf);
    const auto path = scratch_.path() / "e.relume";
    bake_curves(scene_, parameters_, of_cloth, path, {}, measured);
    const std::string text = text_from_description(describe(path));
    EXPECT_NE(text.find("cloth.binary in curves of cloth, by homomorphic"), std::string::npos)
        << text;
    EXPECT_NE(text.find("error by nmf: L2"), std::string::npos) << text;
    EXPECT_NE(text.find("of its values are negative"), std::string::npos) << text;
    EXPECT_THROW((void)edited_materials(scene_, {.edits = {"pearl"}}, measured),
                 program::UsageError);
}

TEST_F(CurveBake, SaysWhichMaterialNoPixelSees) {
    scene::Material hidden = scene_.materials[0];
    hidden.name = "hidden";
    scene_.materials.push_back(hidden);
    const auto path = scratch_.path() / "e.relume";
    bake_curves(scene_, parameters_, edits({.edits = {"pearl", "hidden"}}), path);
    const nlohmann::json description = describe(path);
    EXPECT_NE(
        text_from_description(description).find("no pixel sees the edited material hidden"),
        std::string::npos);
}

TEST_F(CurveBake, RefusesWhatCurvesHaveNot) {
    const auto path = scratch_.path() / "e.relume";
    parameters_.receivers = ReceiverKind::vertices;
    EXPECT_THROW(bake_curves(scene_, parameters_, edits({.edits = {"pearl"}}), path),
                 program::UsageError);
}

}  // namespace
}  // namespace relume::bake
