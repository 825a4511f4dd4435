#include "precompute/scene/obj/materials.h"

#include "precompute/scene/error.h"
#include "precompute/scene/obj/relief.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace relume::scene::obj {
namespace {

std::string who(const MtlMaterial& source) {
    return fmt::format("material '{}'", shown_text(source.name));
}

bool is_black(const Imath::V3f& c) {
    return c.x <= 0 && c.y <= 0 && c.z <= 0;
}

const MtlTexture* texture_of(const MtlMaterial& source, const char* key) {
    const auto found = source.textures.find(key);
    return found != source.textures.end() ? &found->second : nullptr;
}

// A picture of `width`×`height` texels, each made by `texel` from its middle's coordinates.
template <typename Texel>
Texture painted(std::string name, std::uint32_t width, std::uint32_t height, Texel&& texel) {
    std::vector<half> rgba;
    rgba.reserve(std::size_t{4} * width * height);
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < width; ++column) {
            const Imath::V4f value = texel(
                Imath::V2f((static_cast<float>(column) + 0.5F) / static_cast<float>(width),
                           1 - (static_cast<float>(row) + 0.5F) / static_cast<float>(height)));
            for (int c = 0; c < 4; ++c)
                rgba.emplace_back(value[c]);
        }
    }
    return {std::move(name), width, height, std::move(rgba)};
}

}  // namespace

ObjMaterial Materials::from_mtl(const MtlMaterial& source) {
    ObjMaterial target;
    target.material.name = shown_text(source.name);
    const auto has = [&](const char* key) { return texture_of(source, key) != nullptr; };
    add_base(source, target);
    if (source.roughness || source.metallic || has("pr") || has("pm"))
        add_roughness_and_metal(source, target);
    else
        add_shine(source, target);
    add_relief(source, target);
    name_unused(source);
    return target;
}

const Texture* Materials::picture(const MtlMaterial& source,
                                  const char* key,
                                  TextureContent content) {
    const MtlTexture* texture = texture_of(source, key);
    if (texture == nullptr)
        return nullptr;
    if (!texture->ignored.empty())
        unused(source, fmt::format("{} of map {}", shown_text(texture->ignored), key));
    return pictures_.picture(texture->file, content, who(source));
}

TextureUse Materials::use(Texture texture, const MtlTexture& how, ObjMaterial& target) {
    if (how.is_clamped)
        texture.set_wrap(Wrap::clamp, Wrap::clamp);
    UvTransforms& sets = target.uv_sets;
    auto set = std::find(sets.begin(), sets.end(), how.transform);
    if (set == sets.end()) {
        if (sets.size() == kMaxUvSets)
            throw SceneError(
                SceneFault::too_large,
                fmt::format("material '{}' places its textures in more than {} ways",
                            target.material.name, kMaxUvSets));
        set = sets.insert(sets.end(), how.transform);
    }
    return {pictures_.add(std::move(texture)), static_cast<std::uint32_t>(set - sets.begin())};
}

// Kd and map_Kd; map_d cuts holes, for which it becomes the alpha of the colour.
void Materials::add_base(const MtlMaterial& source, ObjMaterial& target) {
    Material& material = target.material;
    const Texture* colour = picture(source, "kd", TextureContent::colour);
    material.base_colour = source.diffuse.value_or(Imath::V3f(colour != nullptr ? 1.0F : 0.5F));
    if (colour != nullptr && is_black(material.base_colour))
        repaired(source, "Kd is 0, which makes its texture black");
    const Texture* mask = picture(source, "d", TextureContent::data);
    if (mask == nullptr) {
        if (colour != nullptr)
            material.base_texture = use(*colour, *texture_of(source, "kd"), target);
        return;
    }
    const MtlTexture& mask_use = *texture_of(source, "d");
    const MtlTexture& place = colour != nullptr ? *texture_of(source, "kd") : mask_use;
    if (!(place.transform == mask_use.transform))
        unused(source, "-s and -o of map_d (those of map_Kd are used)");
    const Texture& larger =
        colour != nullptr && colour->width() > mask->width() ? *colour : *mask;
    const auto alpha = mask_channel(*mask, mask_use);
    material.base_texture = use(
        painted(mask->name(), larger.width(), larger.height(),
                [&](const Imath::V2f& uv) {
                    Imath::V4f value = colour != nullptr ? colour->evaluate(uv) : Imath::V4f(1);
                    value.w = alpha(mask->evaluate(uv));
                    return value;
                }),
        place, target);
    material.alpha_cutoff = 0.5F;
    repaired(source, "map_d cuts holes where it is below 0.5");
}

void Materials::add_shine(const MtlMaterial& source, ObjMaterial& target) {
    Material& material = target.material;
    const Imath::V3f specular =
        source.specular.value_or(Imath::V3f(texture_of(source, "ks") != nullptr ? 1.0F : 0.0F));
    const float exponent = source.exponent.value_or(0);
    // `illum` is not asked: many files that leave it out, or say 1, shine.
    if (!(exponent > 0) || is_black(specular)) {
        for (const char* key : {"ks", "ns"}) {
            if (texture_of(source, key) != nullptr)
                unused(source, fmt::format("map_{} (Ks or Ns is 0)", key));
        }
        return;
    }
    material.model = BsdfModel::phong;
    material.specular = specular;
    material.exponent = exponent;
    if (const Texture* tint = picture(source, "ks", TextureContent::colour))
        material.specular_texture = use(*tint, *texture_of(source, "ks"), target);
    if (const Texture* gloss = picture(source, "ns", TextureContent::data)) {
        const auto channel = value_channel(*texture_of(source, "ns"));
        material.exponent_texture = use(
            painted(
                gloss->name(), gloss->width(), gloss->height(),
                [&](const Imath::V2f& uv) { return Imath::V4f(channel(gloss->evaluate(uv))); }),
            *texture_of(source, "ns"), target);
    }
    const Imath::V3f sum = material.base_colour + specular;
    if (std::max({sum.x, sum.y, sum.z}) > 1 && !material.base_texture)
        repaired(source, "Kd + Ks exceed 1, scaled down together");
}

// Pr and Pm with their maps, in the channels in which glTF has them: green and blue.
void Materials::add_roughness_and_metal(const MtlMaterial& source, ObjMaterial& target) {
    Material& material = target.material;
    material.model = BsdfModel::ggx;
    const Texture* rough = picture(source, "pr", TextureContent::data);
    const Texture* metal = picture(source, "pm", TextureContent::data);
    // Without Pr the exponent tells the width of the highlight.
    const float from_exponent =
        source.exponent ? std::pow(2 / (std::max(*source.exponent, 0.0F) + 2), 0.25F) : 1.0F;
    material.roughness = source.roughness.value_or(rough != nullptr ? 1.0F : from_exponent);
    material.metallic = source.metallic.value_or(metal != nullptr ? 1.0F : 0.0F);
    if (texture_of(source, "ns") != nullptr || texture_of(source, "ks") != nullptr)
        unused(source, "map_Ks, map_Ns (Pr and Pm are used)");
    if (rough == nullptr && metal == nullptr)
        return;
    const MtlTexture& place = *texture_of(source, rough != nullptr ? "pr" : "pm");
    if (rough != nullptr && metal != nullptr &&
        !(place.transform == texture_of(source, "pm")->transform))
        unused(source, "-s and -o of map_Pm (those of map_Pr are used)");
    const auto read = [&](const Texture* texture, const char* key, const Imath::V2f& uv) {
        return texture != nullptr
                   ? value_channel(*texture_of(source, key))(texture->evaluate(uv))
                   : 1.0F;
    };
    const auto side = [&](auto of) {
        return std::max(rough != nullptr ? of(*rough) : 1U, metal != nullptr ? of(*metal) : 1U);
    };
    material.surface_texture =
        use(painted("roughness and metal",
                    side([](const Texture& texture) { return texture.width(); }),
                    side([](const Texture& texture) { return texture.height(); }),
                    [&](const Imath::V2f& uv) {
                        return Imath::V4f(1, read(rough, "pr", uv), read(metal, "pm", uv), 1);
                    }),
            place, target);
}

// `norm` is a normal map; `bump` a height, unless its picture is plainly a normal map.
void Materials::add_relief(const MtlMaterial& source, ObjMaterial& target) {
    if (const Texture* normals = picture(source, "norm", TextureContent::data)) {
        target.material.normal_texture = use(*normals, *texture_of(source, "norm"), target);
        return;
    }
    const Texture* bump = picture(source, "bump", TextureContent::data);
    if (bump == nullptr)
        return;
    const MtlTexture& how = *texture_of(source, "bump");
    if (is_normal_map(*bump)) {
        repaired(source, "the picture of map_Bump is a normal map, and is used as one");
        target.material.normal_texture = use(*bump, how, target);
    } else {
        target.material.normal_texture =
            use(normals_from_height(*bump, value_channel(how), how.bump), how, target);
    }
}

void Materials::name_unused(const MtlMaterial& source) {
    const auto has = [&](const char* key) { return texture_of(source, key) != nullptr; };
    if ((source.emission && !is_black(*source.emission)) || has("ke"))
        unused(source, "emission");
    if (source.dissolve < 1)
        unused(source, "transparency (taken as opaque)");
    if (has("disp"))
        unused(source, "displacement map");
    for (const char* key : {"decal", "refl", "ka", "ps", "tr"}) {
        if (has(key))
            unused(source, fmt::format("map {}", key));
    }
    for (const std::string& what : source.ignored)
        unused(source, what);
}

void Materials::unused(const MtlMaterial& source, const std::string& what) {
    scene_.report.unused.push_back(fmt::format("{}: {}", who(source), what));
}

void Materials::repaired(const MtlMaterial& source, const std::string& what) {
    scene_.report.repairs.push_back(fmt::format("{}: {}", who(source), what));
}

}  // namespace relume::scene::obj
