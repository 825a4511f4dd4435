#include "precompute/materials/model_words.h"

#include "precompute/factors/error.h"
#include "precompute/materials/field_baker.h"
#include "protocol/base/files/error.h"
#include "protocol/base/program/usage.h"

#include <gtest/gtest.h>

#include <string>

namespace relume::materials {
namespace {

void expect_fault(const std::string& words, const std::string& named) {
    try {
        (void)model_from_words(words);
        ADD_FAILURE() << words << " was accepted";
    } catch (const program::UsageError& error) {
        EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
}

TEST(ModelWords, NameEveryModel) {
    EXPECT_TRUE(model_from_words("lambert").depends_on_normal);
    EXPECT_FALSE(model_from_words("lambert").depends_on_reflection);
    EXPECT_EQ(model_from_words("lambert:colour=0.5/0.25/0").colours[0],
              Imath::V3f(0.5F, 0.25F, 0));
    EXPECT_FALSE(model_from_words("phong").depends_on_normal);
    EXPECT_LT(model_from_words("phong:exponent=200").width_rad,
              model_from_words("phong:exponent=8").width_rad);
    EXPECT_EQ(model_from_words("phong:exponent=8,colour=0.5").colours[0], Imath::V3f(0.5F));
    const FieldModel gold = model_from_words("ggx:base=1/0.8/0.3,metallic=1,roughness=0.2");
    EXPECT_EQ(gold.lobe_count, 3U);
    ASSERT_EQ(gold.colours.size(), 3U);
    EXPECT_EQ(gold.colours[0], Imath::V3f(0)) << "a metal has no diffuse part";
    EXPECT_EQ(gold.colours[1], Imath::V3f(1, 0.8F, 0.3F));
}

TEST(ModelWords, SayWhatIsWrong) {
    expect_fault("", "one of the models lambert, phong, ggx, measured");
    expect_fault("lambret", "did you mean lambert");
    expect_fault("phong:", "PARAMETER=VALUE");
    expect_fault("phong:exponent", "PARAMETER=VALUE");
    expect_fault("phong:exponents=4", "did you mean exponent");
    expect_fault("phong:exponent=", "exponent is ''");
    expect_fault("phong:exponent=0.5", "from 1 to 10000");
    expect_fault("phong:exponent=nan", "exponent is 'nan'");
    expect_fault("phong:exponent=8/8/8", "exponent is '8/8/8'");
    expect_fault("ggx:roughness=0.01", "roughness is '0.01'");
    expect_fault("ggx:base=1/1", "base is '1/1'");
    expect_fault("ggx:base=1/1/2", "base is '1/1/2'");
    expect_fault("measured", "expected measured:FILE");
    expect_fault("measured:", "expected measured:FILE");
    EXPECT_THROW((void)model_from_words("measured:/no/such.binary"), std::runtime_error);
}

// Before a field is baked its memory is known: as a guess, and as a bound that holds.
TEST(FieldSize, IsStatedBeforeTheBake) {
    for (const char* words : {"lambert", "phong:exponent=30", "ggx:roughness=0.5"}) {
        const FieldModel model = model_from_words(words);
        const FieldParameters parameters{.face_resolution = 16,
                                         .normal_side = 3,
                                         .reflection_side = 5,
                                         .energy_fraction = 0.99,
                                         .samples_per_side = 1};
        const FieldSize size = field_size(model, parameters);
        FieldReport report;
        const tripling::MaterialField field = bake_field(model, parameters, report);
        EXPECT_EQ(size.entries, report.entries) << words;
        EXPECT_LE(field.byte_count(), size.bound_bytes) << words;
        EXPECT_NEAR(static_cast<double>(size.expected_bytes),
                    static_cast<double>(field.byte_count()),
                    0.3 * static_cast<double>(field.byte_count()))
            << words;
    }
}

TEST(FieldSize, IsABoundThatTheBakeKeeps) {
    FieldParameters parameters{.face_resolution = 16, .normal_side = 3, .energy_fraction = 1};
    parameters.most_bytes = 4096;
    EXPECT_EQ(field_size(lambert_model(), parameters).bound_bytes, 4096U);
    FieldReport report;
    EXPECT_THROW((void)bake_field(lambert_model(), parameters, report), std::length_error);
}

TEST(UsualParameters, FollowTheWidthOfTheHighlight) {
    EXPECT_EQ(usual_parameters(lambert_model(), 32).face_resolution, 32U);
    EXPECT_LT(usual_parameters(phong_model(8), 64).reflection_side,
              usual_parameters(phong_model(200), 64).reflection_side);
    // Never more than a grid has.
    EXPECT_LE(usual_parameters(phong_model(1e4F), 64).reflection_side,
              tripling::DirectionGrid::kMostSide);
}

}  // namespace
}  // namespace relume::materials
