#include "precompute/bake/fingerprint.h"

#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace relume::bake {
namespace {

class Hasher {
  public:
    Hasher() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }

    template <typename T>
    void add(const std::vector<T>& values) {
        static_assert(std::has_unique_object_representations_v<T> ||
                      std::is_standard_layout_v<T>);
        add(values.size());
        XXH3_64bits_update(state_.get(), values.data(), values.size() * sizeof(T));
    }
    void add(std::string_view text) {
        add(text.size());
        XXH3_64bits_update(state_.get(), text.data(), text.size());
    }
    void add(std::uint64_t value) { XXH3_64bits_update(state_.get(), &value, sizeof(value)); }
    void add(double value) { XXH3_64bits_update(state_.get(), &value, sizeof(value)); }
    void add(float value) { XXH3_64bits_update(state_.get(), &value, sizeof(value)); }
    void add(const Imath::V3f& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    // 0 for nothing, so that no index may be taken for it.
    void add(const std::optional<scene::TextureUse>& use) {
        add(use ? std::uint64_t{use->texture} + 1 : std::uint64_t{0});
        add(use ? std::uint64_t{use->uv_set} : std::uint64_t{0});
    }

    [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

  private:
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_;
};

void add(Hasher& hasher, const scene::Mesh& mesh) {
    hasher.add(mesh.positions);
    hasher.add(mesh.normals);
    hasher.add(mesh.tangents);
    hasher.add(mesh.uvs);
    for (const std::vector<Imath::V2f>& set : mesh.more_uvs) {
        hasher.add(set);
    }
    hasher.add(mesh.colours);
    hasher.add(mesh.opacities);
    hasher.add(mesh.triangles);
    hasher.add(std::uint64_t{mesh.material});
}

void add(Hasher& hasher, const scene::Material& material) {
    hasher.add(static_cast<std::uint64_t>(material.model));
    hasher.add(material.base_colour);
    hasher.add(material.specular);
    hasher.add(material.dielectric_f0);
    for (const float value :
         {material.exponent, material.metallic, material.roughness, material.dielectric_f90,
          material.normal_scale, material.opacity}) {
        hasher.add(value);
    }
    hasher.add(material.alpha_cutoff.value_or(-1));
    for (const auto& use :
         {material.base_texture, material.specular_texture, material.exponent_texture,
          material.surface_texture, material.gloss_texture, material.dielectric_texture,
          material.dielectric_colour_texture, material.normal_texture}) {
        hasher.add(use);
    }
}

void add(Hasher& hasher, const scene::Texture& texture) {
    hasher.add(std::uint64_t{texture.width()});
    hasher.add(std::uint64_t{texture.height()});
    hasher.add(static_cast<std::uint64_t>(texture.wrap_u()));
    hasher.add(static_cast<std::uint64_t>(texture.wrap_v()));
    hasher.add(std::string_view(reinterpret_cast<const char*>(texture.texels().data()),
                                texture.texels().size_bytes()));
}

}  // namespace

std::uint64_t fingerprint_of(const scene::Scene& scene,
                             const scene::Camera& camera,
                             const BakeParameters& parameters,
                             std::string_view generator,
                             std::string_view signal) {
    Hasher hasher;
    hasher.add(generator);
    hasher.add(std::string_view(json_from_parameters(parameters).dump()));
    hasher.add(camera.eye());
    for (const double value :
         {scene.frame.origin.x, scene.frame.origin.y, scene.frame.origin.z, scene.frame.unit}) {
        hasher.add(value);
    }
    hasher.add(camera.right());
    hasher.add(camera.up());
    hasher.add(camera.forward());
    hasher.add(camera.tan_half_width());
    hasher.add(camera.tan_half_height());
    hasher.add(std::uint64_t{scene.meshes.size()});
    for (const scene::Mesh& mesh : scene.meshes) {
        add(hasher, mesh);
    }
    hasher.add(std::uint64_t{scene.materials.size()});
    for (const scene::Material& material : scene.materials) {
        add(hasher, material);
    }
    hasher.add(std::uint64_t{scene.textures.size()});
    for (const scene::Texture& texture : scene.textures) {
        add(hasher, texture);
    }
    if (!signal.empty()) {
        hasher.add(signal);
    }
    return hasher.digest();
}

}  // namespace relume::bake
