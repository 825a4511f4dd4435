#include "precompute/scene/import_materials.h"

#include "base/text/near_files.h"
#include "precompute/scene/error.h"
#include "precompute/scene/import_folder.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::scene {
namespace {

// assimp's key macros expand to three arguments; these overloads take them as they come.
float number(
    const aiMaterial& m, const char* key, unsigned type, unsigned index, float otherwise) {
    float value = otherwise;
    const bool is_there = m.Get(key, type, index, value) == aiReturn_SUCCESS;
    return is_there && std::isfinite(value) ? value : otherwise;
}

Imath::V3f colour(const aiMaterial& m,
                  const char* key,
                  unsigned type,
                  unsigned index,
                  const Imath::V3f& otherwise) {
    aiColor3D value;
    if (m.Get(key, type, index, value) != aiReturn_SUCCESS)
        return otherwise;
    return {value.r, value.g, value.b};
}

bool is_black(const Imath::V3f& c) {
    return c.x <= 0 && c.y <= 0 && c.z <= 0;
}

Wrap wrap_of(aiTextureMapMode mode) {
    switch (mode) {
        case aiTextureMapMode_Mirror:
            return Wrap::mirror;
        case aiTextureMapMode_Clamp:
        case aiTextureMapMode_Decal:
            return Wrap::clamp;
        default:
            return Wrap::repeat;
    }
}

std::string name_of(const aiMaterial& m, std::size_t index) {
    aiString name;
    if (m.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0)
        return name.C_Str();
    return fmt::format("material {}", index);
}

}  // namespace

MaterialImporter::MaterialImporter(const aiScene& source,
                                   FileFormat format,
                                   std::filesystem::path folder,
                                   std::uint32_t max_textures,
                                   Scene& scene)
    : source_(source),
      format_(format),
      folder_(std::move(folder)),
      max_textures_(max_textures),
      scene_(scene) {}

void MaterialImporter::import_all() {
    for (std::size_t i = 0; i < source_.mNumMaterials; ++i) {
        const aiMaterial& from = *source_.mMaterials[i];
        Material material = format_ == FileFormat::obj ? from_mtl(from) : from_ply(from);
        material.name = name_of(from, i);
        report_unused(from, material);
        scene_.materials.push_back(std::move(material));
    }
}

Material MaterialImporter::from_mtl(const aiMaterial& m) {
    Material material;
    material.name = name_of(m, scene_.materials.size());
    material.base_colour = colour(m, AI_MATKEY_COLOR_DIFFUSE, Imath::V3f(0.5F));
    material.base_texture =
        texture(m, aiTextureType_DIFFUSE, 0, TextureContent::colour, material);
    const Imath::V3f specular = colour(m, AI_MATKEY_COLOR_SPECULAR, Imath::V3f(0));
    const float exponent = number(m, AI_MATKEY_SHININESS, 0);
    // `illum` is not asked: files that leave it out read as `illum 1`, and many that shine do.
    if (exponent > 0 && !is_black(specular)) {
        material.model = BsdfModel::phong;
        material.specular = specular;
        material.exponent = exponent;
        const Imath::V3f sum = material.base_colour + specular;
        if (std::max({sum.x, sum.y, sum.z}) > 1 && !material.base_texture)
            scene_.report.repairs.push_back(fmt::format(
                "material '{}': Kd + Ks exceed 1, scaled down together", material.name));
    }
    return material;
}

Material MaterialImporter::from_ply(const aiMaterial& m) {
    Material material;
    material.name = name_of(m, scene_.materials.size());
    // PLY has no materials of its own: assimp's stand-in is not the file's word.
    material.base_texture =
        texture(m, aiTextureType_DIFFUSE, 0, TextureContent::colour, material);
    if (material.base_texture)
        material.base_colour = Imath::V3f(1);
    return material;
}

void MaterialImporter::report_unused(const aiMaterial& m, const Material& material) {
    if (!is_black(colour(m, AI_MATKEY_COLOR_EMISSIVE, Imath::V3f(0))) ||
        m.GetTextureCount(aiTextureType_EMISSIVE) > 0)
        unused(material, "emission");
    if (format_ != FileFormat::obj)
        return;
    if (number(m, AI_MATKEY_OPACITY, 1) < 1 || m.GetTextureCount(aiTextureType_OPACITY) > 0)
        unused(material, "transparency (taken as opaque)");
    if (m.GetTextureCount(aiTextureType_SPECULAR) > 0)
        unused(material, "specular map");
    if (m.GetTextureCount(aiTextureType_HEIGHT) +
            m.GetTextureCount(aiTextureType_DISPLACEMENT) >
        0)
        unused(material, "bump or displacement map");
}

void MaterialImporter::unused(const Material& material, const std::string& what) {
    scene_.report.unused.push_back(fmt::format("material '{}': {}", material.name, what));
}

std::optional<TextureIndex> MaterialImporter::texture(const aiMaterial& m,
                                                      aiTextureType type,
                                                      unsigned index,
                                                      TextureContent content,
                                                      const Material& user) {
    aiString path;
    if (m.GetTexture(type, index, &path) != aiReturn_SUCCESS || path.length == 0)
        return std::nullopt;
    int wrap_u = aiTextureMapMode_Wrap;
    int wrap_v = aiTextureMapMode_Wrap;
    m.Get(AI_MATKEY_MAPPINGMODE_U(type, index), wrap_u);
    m.Get(AI_MATKEY_MAPPINGMODE_V(type, index), wrap_v);

    const std::string reference = path.C_Str();
    const std::string key =
        fmt::format("{} {} {} {}", static_cast<int>(content), wrap_u, wrap_v, reference);
    if (const auto known = loaded_.find(key); known != loaded_.end())
        return known->second;
    const auto result = texture_from_file(reference, content, user);
    if (result)
        scene_.textures[*result].set_wrap(wrap_of(static_cast<aiTextureMapMode>(wrap_u)),
                                          wrap_of(static_cast<aiTextureMapMode>(wrap_v)));
    loaded_.emplace(key, result);
    return result;
}

std::optional<TextureIndex> MaterialImporter::texture_from_file(const std::string& reference,
                                                                TextureContent content,
                                                                const Material& user) {
    const auto path = path_inside(folder_, reference);
    if (!path) {
        unused(user, fmt::format("texture '{}' (outside the scene's folder)", reference));
        return std::nullopt;
    }
    if (std::error_code error; !std::filesystem::exists(*path, error)) {
        unused(user,
               fmt::format("texture '{}': {}", reference, text::text_from_missing_file(*path)));
        return std::nullopt;
    }
    return add(load_texture(path->string(), content));
}

TextureIndex MaterialImporter::add(Texture texture) {
    if (scene_.textures.size() >= max_textures_)
        throw SceneError(
            SceneFault::too_large,
            fmt::format("scene '{}' has more than {} textures", scene_.name, max_textures_));
    scene_.textures.push_back(std::move(texture));
    return static_cast<TextureIndex>(scene_.textures.size() - 1);
}

}  // namespace relume::scene
