#include "precompute/bake/fields/editable_material.h"

#include "precompute/bake/base/material_names.h"
#include "precompute/bake/curves/edited_material.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/material_ids.h"
#include "protocol/curve/curve_json.h"

namespace relume::bake {
namespace {

bool has_specular_textures(const scene::Material& material) {
    switch (material.model) {
        case scene::BsdfModel::lambert:
            return false;
        case scene::BsdfModel::phong:
            return material.specular_texture || material.exponent_texture;
        case scene::BsdfModel::ggx:
            break;
    }
    return material.surface_texture || material.gloss_texture || material.dielectric_texture ||
           material.dielectric_colour_texture ||
           (material.base_texture && material.metallic > 0);
}

transport::EditableRecord record_of(const scene::Material& material, text::MaterialIds& ids) {
    transport::EditableRecord record{
        .id = ids.next(material.name), .name = material.name, .brdf = nullptr, .coat = {}};
    if (material.model != scene::BsdfModel::lambert) {
        record.brdf = curve::json_from_curve_brdf(curve_brdf_of(material));
    }
    if (material.model == scene::BsdfModel::ggx) {
        const brdf::Coat coat = bsdf_without_textures(material).coat();
        record.coat = transport::CoatRecord{.f0 = coat.f0, .f90 = coat.f90};
    }
    return record;
}

}  // namespace

std::vector<EditableMaterial> editable_materials(const scene::Scene& scene,
                                                 const FieldRequest& request) {
    std::vector<EditableMaterial> materials;
    text::MaterialIds ids;
    for (const std::string& name : request.editable) {
        const auto found = find_material(scene, name);
        if (!found) {
            throw program::UsageError(no_such_material("--editable " + name, name, scene));
        }
        const scene::Material& material = scene.materials[*found];
        materials.push_back({.material = *found,
                             .record = record_of(material, ids),
                             .has_specular_textures = has_specular_textures(material)});
    }
    return materials;
}

}  // namespace relume::bake
