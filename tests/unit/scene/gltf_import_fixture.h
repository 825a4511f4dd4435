// Tests that import a glTF document of their own.
#pragma once

#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/scene/gltf_builder.h"

#include <gtest/gtest.h>

#include <string>

namespace relume::test {

class GltfImport : public testing::Test {
  protected:
    scene::Scene import(const GltfBuilder& builder) {
        write_json(scratch_.path() / "scene.gltf", builder.document);
        return scene::import_scene(scratch_.path() / "scene.gltf");
    }
    // What the SceneError of this kind says; fails the test where there is none.
    std::string refusal(const GltfBuilder& builder, scene::SceneFault fault) {
        try {
            (void)import(builder);
        } catch (const scene::SceneError& error) {
            EXPECT_EQ(error.fault(), fault) << error.what();
            return error.what();
        }
        ADD_FAILURE() << "was imported";
        return "";
    }
    ScratchDirectory scratch_;
};

}  // namespace relume::test
