#include "precompute/bake/fields/vertex_fields.h"

namespace relume::bake {

VertexFields::VertexFields(const RayCaster& caster,
                           const Receivers& vertices,
                           const FieldRequest& request,
                           const BakeParameters& parameters)
    : caster_(caster),
      vertices_(vertices),
      seed_(parameters.seed),
      face_resolution_(request.resolution_of(parameters)) {
    check_field_bytes(point_count(), face_resolution_,
                      "fewer --vertices or a coarser --visibility-resolution");
}

nlohmann::json VertexFields::request_json() const {
    return {{"fields", true}, {"visibility_resolution", face_resolution_}};
}

FieldBlock VertexFields::points_of(std::uint32_t block) const {
    FieldBlock points;
    for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
        const auto receiver = vertices_.receiver_at(block, slot);
        if (!receiver) {
            continue;
        }
        const Receiver vertex = vertices_.look(*receiver);
        const ReceiverSurface& surface = vertex.surfaces.front();
        points.looking.push_back({.origins = surface.origins,
                                  .geometric_normal = surface.point.geometric_normal,
                                  .shift = jitter_shift(vertex.place, surface.number, seed_)});
    }
    return points;
}

void VertexFields::bake(const FieldWork& work) {
    baked_ = bake_fields(caster_, *this, LightTexels(face_resolution_, seed_), work);
}

void VertexFields::write(transport::TransportWriter& writer) const {
    writer.write_visibility(baked_->visibility);
}

}  // namespace relume::bake
