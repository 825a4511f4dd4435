// The pictures of a document, decoded when a material asks for them.
#pragma once

#include "precompute/scene/gltf/buffer_views.h"
#include "precompute/scene/gltf/document.h"
#include "precompute/scene/gltf/resources.h"
#include "precompute/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace relume::scene::gltf {

class Textures {
  public:
    // All must outlive this. No more than `max_textures` are decoded.
    Textures(const Document& document,
             BufferViews& views,
             Resources& resources,
             std::uint32_t max_textures,
             Scene& scene);

    // Texture `index` of the document as one of the scene's; nothing where its picture is not
    // there, which the report names with `user`. Throws SceneError (corrupt_file, bad_texture,
    // too_large).
    [[nodiscard]] std::optional<TextureIndex> texture(int index,
                                                      TextureContent content,
                                                      const std::string& user);

  private:
    using Key = std::tuple<std::size_t, TextureContent, Wrap, Wrap>;

    [[nodiscard]] std::optional<std::size_t> image_of(std::size_t texture,
                                                      const std::string& user);
    [[nodiscard]] std::optional<Texture> decoded(std::size_t image,
                                                 TextureContent content,
                                                 const std::string& user);
    void unused(const std::string& user, const std::string& what);

    const Document& document_;
    BufferViews& views_;
    Resources& resources_;
    std::uint32_t max_textures_;
    Scene& scene_;
    std::map<Key, std::optional<TextureIndex>> known_;
};

}  // namespace relume::scene::gltf
