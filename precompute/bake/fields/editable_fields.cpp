#include "precompute/bake/fields/editable_fields.h"

#include "precompute/bake/base/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace relume::bake {
namespace {

EditableIndices indices_of(const scene::Scene& scene,
                           const std::vector<EditableMaterial>& materials) {
    EditableIndices indices(scene.materials.size());
    for (std::size_t i = 0; i < materials.size(); ++i) {
        indices[materials[i].material] = static_cast<std::uint8_t>(i);
    }
    return indices;
}

}  // namespace

EditableFields::EditableFields(const RayCaster& caster,
                               const Receivers& pixels,
                               const FieldRequest& request,
                               const BakeParameters& parameters)
    : caster_(caster),
      pixels_(pixels),
      seed_(parameters.seed),
      face_resolution_(request.resolution_of(parameters)),
      materials_(editable_materials(caster.scene(), request)),
      indices_(indices_of(caster.scene(), materials_)),
      point_count_(count_points()) {
    constexpr const char* kRemedies =
        "a smaller image, fewer editable materials or a coarser --visibility-resolution";
    if (point_count_ > transport::SeenPoints::kMostPoints) {
        throw BakeError(fmt::format(
            "--editable: pixels see {} points of these materials, expected at most {}: {}",
            point_count_, transport::SeenPoints::kMostPoints, kRemedies));
    }
    check_field_bytes(point_count_, face_resolution_, kRemedies);
}

std::uint64_t EditableFields::count_points() const {
    std::atomic<std::uint64_t> count = 0;
    tbb::parallel_for(std::uint32_t{0}, block_count(),
                      [&](std::uint32_t block) { count += points_of(block).looking.size(); });
    return count;
}

nlohmann::json EditableFields::request_json() const {
    nlohmann::json names = nlohmann::json::array();
    for (const EditableMaterial& material : materials_) {
        names.push_back(material.record.name);
    }
    return {{"editable", std::move(names)}, {"visibility_resolution", face_resolution_}};
}

FieldBlock EditableFields::points_of(std::uint32_t block) const {
    FieldBlock points;
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
        const auto receiver = pixels_.receiver_at(block, slot);
        if (!receiver) {
            continue;
        }
        for (PixelPoint& point : points_of_pixel(pixels_.look(*receiver), indices_, seed_)) {
            point.seen.slot = static_cast<std::uint8_t>(slot);
            points.seen.push_back(point.seen);
            points.looking.push_back(point.looking);
        }
    }
    return points;
}

void EditableFields::bake(const FieldWork& work) {
    baked_ = bake_fields(caster_, *this, LightTexels(face_resolution_, seed_), work);
}

void EditableFields::write(transport::TransportWriter& writer) const {
    std::vector<transport::EditableRecord> records;
    for (const EditableMaterial& material : materials_) {
        records.push_back(material.record);
    }
    writer.write_materials(baked_->visibility, baked_->points, std::move(records));
}

}  // namespace relume::bake
