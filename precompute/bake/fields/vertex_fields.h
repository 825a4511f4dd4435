// What the vertices of a surface see of the light, by cluster: the visibility that triple
// products are made of [Ng04 §3].
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/bake/fields/field_bake.h"
#include "precompute/bake/receivers/receivers.h"
#include "protocol/transport/transport_writer.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>

namespace relume::bake {

class VertexFields final : public FieldSource {
  public:
    // Of receivers that have one surface each, whose geometric normal is that of the vertex.
    // Keeps references to both. Throws BakeError for more bits than a bake takes.
    VertexFields(const RayCaster& caster,
                 const Receivers& vertices,
                 const FieldRequest& request,
                 const BakeParameters& parameters);

    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    // All that changes the result beside scene and parameters; of the manifest's `bake` too.
    [[nodiscard]] nlohmann::json request_json() const;

    [[nodiscard]] std::uint32_t block_count() const override {
        return vertices_.cluster_count();
    }
    [[nodiscard]] std::uint64_t point_count() const override {
        return vertices_.receiver_count();
    }
    // The vertices of the cluster; rays leave from around each.
    [[nodiscard]] FieldBlock points_of(std::uint32_t block) const override;

    // Throws BakeError, BakeInterrupted, files::FileError.
    void bake(const FieldWork& work);
    // After bake().
    [[nodiscard]] const FieldCounts& counts() const { return baked_->counts; }
    void write(transport::TransportWriter& writer) const;

  private:
    const RayCaster& caster_;
    const Receivers& vertices_;
    std::uint64_t seed_;
    std::uint32_t face_resolution_;
    std::optional<BakedFields> baked_;
};

}  // namespace relume::bake
