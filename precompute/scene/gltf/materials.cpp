#include "precompute/scene/gltf/materials.h"

#include "precompute/scene/gltf/extensions.h"
#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::scene::gltf {
namespace {

constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* kSpecular = "KHR_materials_specular";
constexpr const char* kIor = "KHR_materials_ior";
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";

// An extension's members, with their defaults where it has none.
class Members {
  public:
    Members(const tinygltf::ExtensionMap& extensions, const char* name) {
        const auto found = extensions.find(name);
        if (found != extensions.end() && found->second.IsObject())
            value_ = &found->second;
    }
    [[nodiscard]] bool are_there() const { return value_ != nullptr; }
    [[nodiscard]] double number(const char* member, double otherwise) const {
        const tinygltf::Value& value = get(member);
        return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
    }
    [[nodiscard]] Imath::V3f colour(const char* member) const {
        const tinygltf::Value& value = get(member);
        if (!value.IsArray() || value.ArrayLen() < 3)
            return {1, 1, 1};
        const auto channel = [&](int c) {
            return static_cast<float>(value.Get(c).GetNumberAsDouble());
        };
        return {channel(0), channel(1), channel(2)};
    }
    // The fourth number of a colour.
    [[nodiscard]] double alpha(const char* member) const {
        const tinygltf::Value& value = get(member);
        return value.IsArray() && value.ArrayLen() > 3 ? value.Get(3).GetNumberAsDouble() : 1.0;
    }
    [[nodiscard]] tinygltf::TextureInfo texture(const char* member) const {
        tinygltf::TextureInfo info;
        const tinygltf::Value& value = get(member);
        if (!value.IsObject())
            return info;
        const auto whole = [&](const char* name, int otherwise) {
            const tinygltf::Value& found = value.Get(std::string(name));
            return found.IsNumber() ? found.GetNumberAsInt() : otherwise;
        };
        info.index = whole("index", -1);
        info.texCoord = whole("texCoord", 0);
        const tinygltf::Value& inner = value.Get(std::string("extensions"));
        for (const std::string& name : inner.Keys())
            info.extensions.emplace(name, inner.Get(name));
        return info;
    }

  private:
    [[nodiscard]] const tinygltf::Value& get(const char* member) const {
        static const tinygltf::Value kNothing;
        return value_ == nullptr ? kNothing : value_->Get(std::string(member));
    }
    const tinygltf::Value* value_ = nullptr;
};

// ((ior − 1)/(ior + 1))²; an ior of 0 stands for a surface that reflects all
// (KHR_materials_ior).
float f0_from_ior(double ior) {
    if (ior == 0)
        return 1;
    const double root = (std::max(ior, 1.0) - 1.0) / (std::max(ior, 1.0) + 1.0);
    return static_cast<float>(root * root);
}

bool is_black(const std::vector<double>& colour) {
    return std::all_of(colour.begin(), colour.end(), [](double c) { return c <= 0; });
}

float finite(double value, double otherwise) {
    return static_cast<float>(std::isfinite(value) ? value : otherwise);
}

// Fills one material; its textures and their sets of coordinates go with it.
class Filler {
  public:
    Filler(const FileName& file, Textures& textures, std::string user, MaterialUse& use)
        : file_(file), textures_(textures), user_(std::move(user)), use_(use) {}

    template <typename Info>
    std::optional<TextureUse> texture(const Info& info, TextureContent content) {
        if (info.index < 0)
            return std::nullopt;
        const auto index = textures_.texture(info.index, content, user_);
        if (!index)
            return std::nullopt;
        const UvSource source = uv_source_of(info.texCoord, info.extensions, file_, user_);
        return TextureUse(*index, uv_set_of(source, use_.uvs, file_, user_));
    }

    void metallic_roughness(const tinygltf::PbrMetallicRoughness& pbr, Material& material) {
        const std::vector<double>& base = pbr.baseColorFactor;
        material.base_colour = {finite(base[0], 1), finite(base[1], 1), finite(base[2], 1)};
        material.opacity = finite(base[3], 1);
        material.metallic = finite(pbr.metallicFactor, 1);
        material.roughness = finite(pbr.roughnessFactor, 1);
        material.base_texture = texture(pbr.baseColorTexture, TextureContent::colour);
        material.surface_texture = texture(pbr.metallicRoughnessTexture, TextureContent::data);
    }

    void specular_glossiness(const Members& members, Material& material) {
        material.base_colour = members.colour("diffuseFactor");
        material.opacity = finite(members.alpha("diffuseFactor"), 1);
        material.metallic = 0;
        material.roughness = 1.0F - finite(members.number("glossinessFactor", 1), 1);
        material.dielectric_f0 = members.colour("specularFactor");
        material.base_texture =
            texture(members.texture("diffuseTexture"), TextureContent::colour);
        material.gloss_texture =
            texture(members.texture("specularGlossinessTexture"), TextureContent::colour);
        material.dielectric_colour_texture = material.gloss_texture;
    }

    void dielectric(const Members& ior, const Members& specular, Material& material) {
        material.dielectric_f0 = Imath::V3f(f0_from_ior(ior.number("ior", 1.5)));
        if (!specular.are_there())
            return;
        material.dielectric_f0 *= specular.colour("specularColorFactor");
        material.dielectric_f90 = finite(specular.number("specularFactor", 1), 1);
        material.dielectric_texture =
            texture(specular.texture("specularTexture"), TextureContent::data);
        material.dielectric_colour_texture =
            texture(specular.texture("specularColorTexture"), TextureContent::colour);
    }

  private:
    const FileName& file_;
    Textures& textures_;
    std::string user_;
    MaterialUse& use_;
};

}  // namespace

Materials::Materials(const Document& document, Textures& textures, Scene& scene)
    : document_(document),
      textures_(textures),
      scene_(scene),
      known_(document.model.materials.size() + 1) {}

const MaterialUse& Materials::use(int index, const std::string& who) {
    const auto& materials = document_.model.materials;
    std::size_t place = materials.size();
    if (index >= 0)
        place = document_.file.checked_index(index, materials.size(), who, "material");
    if (!known_[place]) {
        if (place < materials.size()) {
            const std::string& name = materials[place].name;
            known_[place] =
                imported(materials[place], name.empty() ? fmt::format("material {}", place)
                                                        : shown_text(original_bytes(name)));
        } else {
            known_[place] = imported(tinygltf::Material(), "default material");
        }
    }
    return *known_[place];
}

MaterialUse Materials::imported(const tinygltf::Material& source, std::string name) {
    const std::string user = fmt::format("material '{}'", name);
    MaterialUse use;
    Material material;
    material.name = std::move(name);
    Filler filler(document_.file, textures_, user, use);
    if (source.extensions.contains(kUnlit)) {
        // Its colour is to be shown as it is, under any light: a picture that light does not
        // change is no part of a transport. A matte surface of that colour is the nearest.
        filler.metallic_roughness(source.pbrMetallicRoughness, material);
        material.model = BsdfModel::lambert;
        material.surface_texture.reset();
        scene_.report.unused.push_back(user +
                                       ": unlit (taken as matte, for its light is to change)");
    } else if (const Members glossy(source.extensions, kGlossiness); glossy.are_there()) {
        material.model = BsdfModel::ggx;
        filler.specular_glossiness(glossy, material);
    } else {
        material.model = BsdfModel::ggx;
        filler.metallic_roughness(source.pbrMetallicRoughness, material);
        filler.dielectric(Members(source.extensions, kIor),
                          Members(source.extensions, kSpecular), material);
    }
    if (material.model == BsdfModel::ggx) {
        material.normal_texture = filler.texture(source.normalTexture, TextureContent::data);
        material.normal_scale = finite(source.normalTexture.scale, 1);
    }
    if (source.alphaMode == "MASK")
        material.alpha_cutoff = finite(source.alphaCutoff, 0.5);
    report_unused(source, user);
    use.material = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    return use;
}

void Materials::report_unused(const tinygltf::Material& source, const std::string& user) {
    const auto unused = [&](const std::string& what) {
        scene_.report.unused.push_back(fmt::format("{}: {}", user, what));
    };
    if (source.alphaMode == "BLEND")
        unused("alpha mode BLEND (taken as opaque)");
    if (!is_black(source.emissiveFactor)) {
        const Members strength(source.extensions, kEmissiveStrength);
        unused(strength.are_there()
                   ? fmt::format("emission of strength {} ({})",
                                 strength.number("emissiveStrength", 1), kEmissiveStrength)
                   : "emission");
    }
    if (source.occlusionTexture.index >= 0)
        unused("occlusion map (the bake computes occlusion)");
    for (const std::string& extension : unused_material_extensions(source.extensions))
        unused(extension);
}

}  // namespace relume::scene::gltf
