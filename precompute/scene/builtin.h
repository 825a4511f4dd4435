// Scenes made by code: the same bits on every run and every machine with the same libm.
#pragma once

#include "precompute/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace relume::scene {

struct BuiltinScene {
    std::string_view name;
    std::string_view description;
    Scene (*build)();
};

// table, box, thin, earrings, street, mesh100k, plane, bowl.
[[nodiscard]] const std::vector<BuiltinScene>& builtin_scenes();
// Throws SceneError (unknown_name), naming those that exist.
[[nodiscard]] Scene build_builtin_scene(std::string_view name);

}  // namespace relume::scene
