// Pictures inside a scene file.
#include "precompute/scene/error.h"
#include "precompute/scene/import_materials.h"
#include "precompute/scene/srgb.h"

#include <assimp/texture.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace relume::scene {

Texture texture_from_embedded(const std::string& name,
                              const aiTexture& source,
                              TextureContent content) {
    if (source.mHeight == 0) {  // a whole image file of mWidth bytes
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(source.pcData);
        const std::string hint = source.achFormatHint;
        return decode_texture(fmt::format("{}.{}", name, hint.empty() ? "png" : hint),
                              {bytes, source.mWidth}, content);
    }
    if (source.mWidth > kMaxTextureSide || source.mHeight > kMaxTextureSide)
        throw SceneError(
            SceneFault::too_large,
            fmt::format("texture '{}' has {}x{} texels; expected at most {}x{}", name,
                        source.mWidth, source.mHeight, kMaxTextureSide, kMaxTextureSide));
    const std::size_t count = std::size_t{source.mWidth} * source.mHeight;
    const auto decoded = [content](std::uint8_t byte) {
        const float value = static_cast<float>(byte) / 255.0F;
        return half(content == TextureContent::colour ? linear_from_srgb(value) : value);
    };
    std::vector<half> rgba;
    rgba.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const aiTexel& texel = source.pcData[i];
        rgba.insert(rgba.end(), {decoded(texel.r), decoded(texel.g), decoded(texel.b),
                                 half(static_cast<float>(texel.a) / 255.0F)});
    }
    return {name, source.mWidth, source.mHeight, std::move(rgba)};
}

}  // namespace relume::scene
