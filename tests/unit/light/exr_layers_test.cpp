// Which layer is taken for the picture, by what renderers call theirs.
#include "protocol/light/exr_layers.h"

#include "protocol/light/environment_error.h"

#include <gtest/gtest.h>

namespace relume::light {
namespace {

ExrPart part(const std::string& name, const std::vector<std::string>& channels) {
    ExrPart result;
    result.name = name;
    for (const std::string& channel : channels) {
        result.channels.push_back({.name = channel});
    }
    return result;
}

std::vector<std::string> rgb(const std::string& prefix) {
    return {prefix + "R", prefix + "G", prefix + "B"};
}

std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> lists) {
    std::vector<std::string> all;
    for (const auto& list : lists) {
        all.insert(all.end(), list.begin(), list.end());
    }
    return all;
}

std::string chosen(const std::vector<ExrPart>& parts, const std::string& label = "") {
    std::vector<std::string> warnings;
    try {
        return choose_layer(parts, label, warnings).label;
    } catch (const EnvironmentError& refusal) {
        return std::string("refused: ") + refusal.what();
    }
}

bool is_refused(const std::vector<ExrPart>& parts, const std::string& words) {
    const std::string answer = chosen(parts);
    return answer.starts_with("refused") && answer.find(words) != std::string::npos;
}

TEST(ExrLayers, TheBeautyOfBlender) {
    EXPECT_EQ(chosen({part("", joined({rgb("ViewLayer.AO."),
                                       rgb("ViewLayer.Combined."),
                                       {"ViewLayer.Depth.Z", "ViewLayer.Normal.X",
                                        "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"},
                                       rgb("ViewLayer.DiffCol.")}))}),
              "ViewLayer.Combined");
    EXPECT_EQ(chosen({part("ViewLayer.AO", rgb("ViewLayer.AO.")),
                      part("ViewLayer.Combined", rgb("ViewLayer.Combined."))}),
              "ViewLayer.Combined");
}

TEST(ExrLayers, TheBeautyOfVRayArnoldAndNuke) {
    EXPECT_EQ(chosen({part("", {".R", ".G", ".B", ".A"})}), "");
    EXPECT_EQ(chosen({part("", joined({rgb("albedo."), rgb("")}))}), "");
    EXPECT_EQ(chosen({part("", joined({rgb("N."), rgb("beauty.")}))}), "beauty");
    EXPECT_EQ(chosen({part("depth", {"Z"}), part("rgba", {"red", "green", "blue", "alpha"})}),
              "rgba");
    EXPECT_EQ(chosen({part("depth", {"depth.Z"}), part("rgba", rgb("rgba."))}), "rgba");
    EXPECT_EQ(chosen({part("", {"Red", "Green", "Blue"})}), "");
    EXPECT_EQ(chosen({part("normals", rgb("")), part("left", rgb(""))}), "left");
}

TEST(ExrLayers, DataIsNeverThePictureUnasked) {
    for (const char* name : {"depth", "AO", "Albedo", "Normal", "N", "P", "crypto_object00",
                             "ViewLayer.CryptoMaterial00", "ViewLayer.Denoising Albedo",
                             "ambient_occlusion", "worldNormals", "motionvector", "Mist"}) {
        const std::vector<ExrPart> file{part("", rgb(std::string(name) + "."))};
        EXPECT_TRUE(is_refused(file, name)) << name << ": " << chosen(file);
        EXPECT_EQ(chosen(file, name), name) << "asked for by name";
        EXPECT_TRUE(is_refused({part(name, rgb("")), part("Z", {"Z"})}, name)) << name;
    }
    EXPECT_TRUE(is_refused({part("", {"Z"})}, "(Z)"));
    EXPECT_TRUE(is_refused({part("", {"N.X", "N.Y", "N.Z"})}, "N (X, Y, Z)"));
}

TEST(ExrLayers, OneLayerOfNoKnownNameIsTakenSeveralAreNot) {
    EXPECT_EQ(chosen({part("", joined({rgb("Sky."), rgb("AO.")}))}), "Sky");
    const std::vector<ExrPart> two{part("", joined({rgb("Sky."), rgb("Sun.")}))};
    EXPECT_TRUE(is_refused(two, "Sky, Sun"));
    EXPECT_EQ(chosen(two, "Sun"), "Sun");
    EXPECT_EQ(chosen(two, "sun"), "Sun");
    EXPECT_NE(chosen(two, "Moon").find("expected one of Sky, Sun"), std::string::npos);
}

TEST(ExrLayers, GreyAndLuminanceWithChroma) {
    const auto kind = [](const std::vector<std::string>& channels) {
        std::vector<std::string> warnings;
        const std::vector<ExrPart> file{part("", channels)};
        return choose_layer(file, "", warnings).kind;
    };
    EXPECT_EQ(kind({"Y"}), ExrLayer::Kind::grey);
    EXPECT_EQ(kind({"A", "Y"}), ExrLayer::Kind::grey);
    EXPECT_EQ(kind({"BY", "RY", "Y"}), ExrLayer::Kind::luminance_chroma);
}

}  // namespace
}  // namespace relume::light
