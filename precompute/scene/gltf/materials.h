// The materials of a document as the bake has them.
#pragma once

#include "precompute/scene/gltf/textures.h"
#include "precompute/scene/gltf/uv_sources.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace relume::scene::gltf {

// A material's place in the scene and what its meshes' sets of texture coordinates are made of.
struct MaterialUse {
    std::uint32_t material = 0;  // index into Scene::materials
    UvSources uvs{};
};

// Makes the materials that meshes ask for, each once.
class Materials {
  public:
    // All must outlive this.
    Materials(const Document& document, Textures& textures, Scene& scene);

    // `index` < 0: the material that glTF gives a primitive without one. Throws SceneError.
    [[nodiscard]] const MaterialUse& use(int index, const std::string& who);
    [[nodiscard]] bool has_holes(const MaterialUse& use) const {
        return scene_.materials[use.material].has_holes();
    }

  private:
    [[nodiscard]] MaterialUse imported(const tinygltf::Material& source, std::string name);
    void report_unused(const tinygltf::Material& source, const std::string& user);

    const Document& document_;
    Textures& textures_;
    Scene& scene_;
    std::vector<std::optional<MaterialUse>> known_;  // the last is the default
};

}  // namespace relume::scene::gltf
