#include "precompute/scene/gltf/textures.h"

#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace relume::scene::gltf {
namespace {

Wrap wrap_of(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirror;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp;
        default:
            return Wrap::repeat;
    }
}

struct PictureFormat {
    std::string_view magic;
    std::size_t at;
    std::string_view extension;
};

using namespace std::string_view_literals;

constexpr std::array<PictureFormat, 9> kFormats{{
    {"\x89PNG"sv, 0, "png"},
    {"\xff\xd8\xff"sv, 0, "jpg"},
    {"WEBP"sv, 8, "webp"},
    {"\xabKTX"sv, 0, "ktx2"},
    {"DDS "sv, 0, "dds"},
    {"\x76\x2f\x31\x01"sv, 0, "exr"},
    {"#?"sv, 0, "hdr"},
    {"BM"sv, 0, "bmp"},
    {"GIF8"sv, 0, "gif"},
}};

// By the bytes themselves: names and media types are often wrong.
std::string_view extension_of(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const PictureFormat& format : kFormats) {
        if (text.size() >= format.at && text.substr(format.at).starts_with(format.magic))
            return format.extension;
    }
    return "png";
}

}  // namespace

Textures::Textures(const Document& document,
                   BufferViews& views,
                   Resources& resources,
                   std::uint32_t max_textures,
                   Scene& scene)
    : document_(document),
      views_(views),
      resources_(resources),
      max_textures_(max_textures),
      scene_(scene) {}

void Textures::unused(const std::string& user, const std::string& what) {
    scene_.report.unused.push_back(fmt::format("{}: {}", user, what));
}

std::optional<std::size_t> Textures::image_of(std::size_t index, const std::string& user) {
    const tinygltf::Texture& texture = document_.model.textures[index];
    const std::string self = label("texture", index, texture.name);
    int source = texture.source;
    const auto extension = texture.extensions.find("EXT_texture_webp");
    if (extension != texture.extensions.end() && extension->second.IsObject()) {
        const tinygltf::Value& webp = extension->second.Get(std::string("source"));
        if (webp.IsNumber())
            source = webp.GetNumberAsInt();
    }
    if (source < 0) {
        std::string others;
        for (const auto& other : texture.extensions)
            others += (others.empty() ? "" : ", ") + shown_text(original_bytes(other.first));
        unused(user, fmt::format("{} ({}; the plain factor is used)", self,
                                 others.empty() ? "no source" : "only as " + others));
        return std::nullopt;
    }
    return document_.file.checked_index(source, document_.images.size(), self, "image");
}

std::optional<Texture> Textures::decoded(std::size_t index,
                                         TextureContent content,
                                         const std::string& user) {
    const ImageSource& image = document_.images[index];
    const std::string self = label("image", index, image.name);
    std::vector<std::uint8_t> own;
    std::span<const std::uint8_t> bytes;
    std::string shown = self;
    if (image.uri) {
        shown = Resources::shown(*image.uri);
        auto read = resources_.read(*image.uri);
        if (!read) {
            unused(user,
                   fmt::format("texture '{}' (no such file in the scene's folder)", shown));
            return std::nullopt;
        }
        own = std::move(*read);
        bytes = own;
    } else {
        bytes = views_.bytes(*image.buffer_view, self);
    }
    const std::string_view format = extension_of(bytes);
    if (format == "ktx2")
        document_.file.refuse(
            SceneFault::bad_texture,
            fmt::format("texture '{}' is KTX2 (Basis Universal), which is not supported; "
                        "expected PNG, JPEG or WebP",
                        shown));
    try {
        // The decoder chooses by the name's end.
        return decode_texture(fmt::format("{}.{}", self, format), bytes, content);
    } catch (const SceneError& error) {
        document_.file.refuse(error.fault(), fmt::format("{}: {}", shown, error.what()));
    }
}

std::optional<TextureIndex> Textures::texture(int index,
                                              TextureContent content,
                                              const std::string& user) {
    const auto& textures = document_.model.textures;
    const std::size_t checked =
        document_.file.checked_index(index, textures.size(), user, "texture");
    const auto image = image_of(checked, user);
    if (!image)
        return std::nullopt;
    Wrap u = Wrap::repeat;
    Wrap v = Wrap::repeat;
    if (const int number = textures[checked].sampler; number >= 0) {
        const auto& samplers = document_.model.samplers;
        const tinygltf::Sampler& sampler = samplers[document_.file.checked_index(
            number, samplers.size(), fmt::format("texture {}", checked), "sampler")];
        u = wrap_of(sampler.wrapS);
        v = wrap_of(sampler.wrapT);
    }
    const Key key{*image, content, u, v};
    if (const auto known = known_.find(key); known != known_.end())
        return known->second;
    std::optional<TextureIndex> result;
    if (scene_.textures.size() >= max_textures_)
        document_.file.refuse(SceneFault::too_large,
                              fmt::format("more than {} textures", max_textures_));
    if (auto texture = decoded(*image, content, user)) {
        texture->set_wrap(u, v);
        scene_.textures.push_back(std::move(*texture));
        result = static_cast<TextureIndex>(scene_.textures.size() - 1);
    }
    known_.emplace(key, result);
    return result;
}

}  // namespace relume::scene::gltf
