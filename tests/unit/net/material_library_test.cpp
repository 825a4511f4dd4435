#include "server/net/library/material_library.h"

#include "tests/support/scratch_directory.h"
#include "tests/unit/net/small_materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace relume::net {
namespace {

namespace fs = std::filesystem;

class MaterialLibraryTest : public testing::Test {
  protected:
    void refresh() { library_.refresh(folder_.path()); }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& family : library_.list()) {
            names.push_back(family->name);
        }
        return names;
    }

    test::ScratchDirectory folder_;
    MaterialLibrary library_{std::size_t{1} << 30};
};

TEST(MaterialName, StepsOfFamiliesAreToldByExponentOrRoughness) {
    const auto is = [](const char* stem, const char* name, const char* parameter, double step) {
        const MaterialName found = material_name_from_stem(stem);
        EXPECT_EQ(found.name, name) << stem;
        EXPECT_EQ(found.parameter.value_or(""), parameter) << stem;
        EXPECT_EQ(found.step, step) << stem;
    };
    is("gold", "gold", "", 0);
    is("phong-exponent-64", "phong", "exponent", 64);
    is("gold-leaf-roughness-0.25", "gold-leaf", "roughness", 0.25);
    for (const char* plain : {"gold-leaf-2", "exponent-64", "-exponent-64", "phong-exponent-",
                              "phong-exponent-0", "phong-exponent--1", "phong-exponent-nan",
                              "phong-exponent-inf", "phong-exponent-64b", "phongexponent-64"}) {
        is(plain, plain, "", 0);
    }
}

TEST_F(MaterialLibraryTest, FilesOfOneFamilyAreOneMaterial) {
    for (const int exponent : {64, 4, 16}) {
        write_small_material(folder_.path(), "phong-exponent-" + std::to_string(exponent),
                             materials::phong_model(static_cast<float>(exponent)));
    }
    write_small_material(folder_.path(), "white", materials::lambert_model());
    refresh();
    EXPECT_EQ(names(), (std::vector<std::string>{"phong", "white"}));
    const auto phong = library_.find("phong", 4);
    ASSERT_TRUE(phong);
    const wire::OfferedMaterial description = phong->description();
    EXPECT_EQ(description.parameter, "exponent");
    EXPECT_EQ(description.steps, (std::vector<double>{4, 16, 64}));
    EXPECT_EQ(description.face_resolution, 4U);
    EXPECT_EQ(description.colours, (std::vector{Imath::V3d(1)}));
    EXPECT_FALSE(library_.find("phong", 8));
    EXPECT_FALSE(library_.find("white", 4)->description().parameter);

    const auto texels = [&](std::size_t step) { return phong->steps[step].material->texels(); };
    EXPECT_EQ(phong->finish(4, {}), triple::Finish(texels(0)));
    EXPECT_EQ(phong->finish(16, {}), triple::Finish(texels(1)));
    EXPECT_EQ(phong->finish({}, {}), triple::Finish(texels(1)));
    EXPECT_EQ(phong->finish(1, {}), triple::Finish(texels(0)));
    EXPECT_EQ(phong->finish(1e5, {}), triple::Finish(texels(2)));
    const triple::Finish between = phong->finish(32, std::vector{Imath::V3f(2)});
    EXPECT_EQ(between.material, texels(1));
    EXPECT_EQ(between.next, texels(2));
    EXPECT_NEAR(between.amount_of_next, 0.5, 1e-6);  // half an octave of two
    EXPECT_EQ(between.colours, (std::vector{Imath::V3f(2)}));
}

TEST_F(MaterialLibraryTest, WhatCannotBeUsedIsLeftOut) {
    write_small_material(folder_.path(), "phong-exponent-4", materials::phong_model(4));
    std::ofstream(folder_.path() / "broken.material") << "RELUMEMF, and no more";
    std::ofstream(folder_.path() / "note.txt") << "no material";
    write_small_material(folder_.path(), "a b", materials::lambert_model());
    // A name that a family has already.
    write_small_material(folder_.path(), "phong", materials::lambert_model());
    materials::FieldModel two = materials::lambert_model();
    two.lobe_count = 2;
    two.colours = {Imath::V3f(1), Imath::V3f(0.5F)};
    const auto one = two.evaluate;
    two.evaluate = [one](const Imath::V3f& normal, const Imath::V3f& reflection,
                         const brdf::Directions& light, std::span<float> out) {
        one(normal, reflection, light, out.first(out.size() / 2));
        one(normal, reflection, light, out.last(out.size() / 2));
    };
    write_small_material(folder_.path(), "phong-exponent-9", two);
    refresh();
    EXPECT_EQ(names(), std::vector<std::string>{"phong"});
    const std::size_t offered = library_.find("phong", 4)->steps.size();
    EXPECT_EQ(offered, 1U);
}

TEST_F(MaterialLibraryTest, FollowsItsFolder) {
    write_small_material(folder_.path(), "one", materials::lambert_model());
    refresh();
    const auto before = library_.find("one", 4);
    ASSERT_TRUE(before);
    const auto texels = before->steps.front().material->texels();
    write_small_material(folder_.path(), "one", materials::phong_model(9));
    write_small_material(folder_.path(), "one-fine", materials::lambert_model(), 8);
    refresh();
    EXPECT_EQ(names(), (std::vector<std::string>{"one", "one-fine"}));
    const auto after = library_.find("one", 4);
    EXPECT_NE(after, before);
    EXPECT_NE(after->steps.front().material->texels(), texels);
    EXPECT_EQ(before->steps.front().material->texels(), texels);  // who holds it keeps it
    fs::remove(folder_.path() / "one.material");
    refresh();
    EXPECT_EQ(names(), std::vector<std::string>{"one-fine"});
}

// A file that is swapped behind the library's back is not the material that was chosen.
TEST_F(MaterialLibraryTest, AMaterialThatWasReplacedUnseenIsRefused) {
    write_small_material(folder_.path(), "one", materials::lambert_model());
    refresh();
    write_small_material(folder_.path(), "one", materials::lambert_model(), 8);
    EXPECT_THROW(static_cast<void>(library_.find("one", 4)->finish({}, {})),
                 tripling::MaterialFileError);
}

TEST(MaterialCache, HoldsNoMoreThanItsBound) {
    const test::ScratchDirectory folder;
    write_small_material(folder.path(), "one", materials::lambert_model());
    MaterialLibrary small(1);
    small.refresh(folder.path());
    EXPECT_TRUE(small.find("one", 4)->finish({}, {}).material);
    EXPECT_EQ(small.resident_bytes(), 0U);
    MaterialLibrary large(std::size_t{1} << 20);
    large.refresh(folder.path());
    const auto kept = large.find("one", 4)->finish({}, {}).material;
    EXPECT_EQ(large.resident_bytes(), kept->byte_count());
}

}  // namespace
}  // namespace relume::net
