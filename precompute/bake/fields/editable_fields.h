// What an image's transport holds of materials that people edit under any light: their points
// in the pixels, and what each point sees of the light.
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/bake/fields/editable_material.h"
#include "precompute/bake/fields/field_bake.h"
#include "precompute/bake/fields/pixel_points.h"
#include "precompute/bake/receivers/receivers.h"
#include "protocol/transport/transport_writer.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace relume::bake {

class EditableFields final : public FieldSource {
  public:
    // Looks at all pixels, to know how many points there are. Keeps references to caster and
    // pixels. Throws program::UsageError for names that no material has; BakeError for more
    // points than a transport may hold.
    EditableFields(const RayCaster& caster,
                   const Receivers& pixels,
                   const FieldRequest& request,
                   const BakeParameters& parameters);

    [[nodiscard]] const std::vector<EditableMaterial>& materials() const { return materials_; }
    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    // All that changes the result beside scene and parameters; of the manifest's `bake` too.
    [[nodiscard]] nlohmann::json request_json() const;

    [[nodiscard]] std::uint32_t block_count() const override { return pixels_.cluster_count(); }
    [[nodiscard]] std::uint64_t point_count() const override { return point_count_; }
    [[nodiscard]] FieldBlock points_of(std::uint32_t block) const override;

    // Throws BakeError, BakeInterrupted, files::FileError.
    void bake(const FieldWork& work);
    // After bake().
    [[nodiscard]] const FieldCounts& counts() const { return baked_->counts; }
    void write(transport::TransportWriter& writer) const;

  private:
    [[nodiscard]] std::uint64_t count_points() const;

    const RayCaster& caster_;
    const Receivers& pixels_;
    std::uint64_t seed_;
    std::uint32_t face_resolution_;
    std::vector<EditableMaterial> materials_;
    EditableIndices indices_;
    std::uint64_t point_count_ = 0;
    std::optional<BakedFields> baked_;
};

}  // namespace relume::bake
