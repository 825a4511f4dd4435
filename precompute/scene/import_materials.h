// Materials of an assimp scene, with the textures they use.
#pragma once

#include "precompute/scene/scene.h"

#include <assimp/material.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

struct aiMaterial;
struct aiScene;

namespace relume::scene {

enum class FileFormat : std::uint8_t { gltf, obj, ply };

// Appends to the scene's materials, textures and report.
class MaterialImporter {
  public:
    MaterialImporter(const aiScene& source,
                     FileFormat format,
                     std::filesystem::path folder,
                     std::uint32_t max_textures,
                     Scene& scene);
    // One Material per aiMaterial, in order. Throws SceneError for a texture that is there and
    // cannot be decoded; one that is missing is reported and the plain colour used.
    void import_all();

  private:
    [[nodiscard]] Material from_mtl(const aiMaterial& source);
    [[nodiscard]] Material from_ply(const aiMaterial& source);
    void report_unused(const aiMaterial& source, const Material& material);
    [[nodiscard]] std::optional<TextureIndex> texture(const aiMaterial& source,
                                                      aiTextureType type,
                                                      unsigned index,
                                                      TextureContent content,
                                                      const Material& user);
    [[nodiscard]] std::optional<TextureIndex> texture_from_file(const std::string& reference,
                                                                TextureContent content,
                                                                const Material& user);
    [[nodiscard]] TextureIndex add(Texture texture);
    void unused(const Material& material, const std::string& what);

    const aiScene& source_;
    FileFormat format_;
    std::filesystem::path folder_;
    std::uint32_t max_textures_;
    Scene& scene_;
    std::map<std::string, std::optional<TextureIndex>>
        loaded_;  // key: content, wrap, reference
};

}  // namespace relume::scene
