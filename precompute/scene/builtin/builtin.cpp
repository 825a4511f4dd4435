#include "precompute/scene/builtin.h"

#include "precompute/scene/builtin/scenes.h"
#include "precompute/scene/error.h"
#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

namespace relume::scene {

const std::vector<BuiltinScene>& builtin_scenes() {
    static const std::vector<BuiltinScene> scenes{
        {"table", "a table with chairs, a plant and glossy crockery: intricate shadows",
         build_table},
        {"box", "an open box with coloured walls: interreflection", build_box},
        {"thin", "a golden knot under a grille of thin bars: glossy, fine shadows", build_thin},
        {"earrings",
         "two pearls on metal posts, a cloth draped over a pedestal: soft and sharp gloss",
         build_earrings},
        {"street", "lamp posts, a pillar box and trees on a pavement: to walk around in",
         build_street},
        {"mesh100k", "a displaced ball of 100,800 triangles on a ground plane", build_mesh100k},
        {"plane", "one white plane seen from above: shows its albedo under constant light",
         build_plane},
        {"bowl", "a white hollow: shows 1 everywhere under constant light", build_bowl},
    };
    return scenes;
}

Scene build_builtin_scene(std::string_view name) {
    std::vector<std::string> known;
    for (const BuiltinScene& scene : builtin_scenes()) {
        if (scene.name == name)
            return scene.build();
        known.emplace_back(scene.name);
    }
    throw SceneError(SceneFault::unknown_name,
                     fmt::format("no built-in scene '{}'; expected {}", name,
                                 text::expected_name(name, known, "built-in scenes")));
}

}  // namespace relume::scene
