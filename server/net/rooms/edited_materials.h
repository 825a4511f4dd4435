// A room's edits of materials, as what its scene shows beside its light.
#pragma once

#include "protocol/wire/sections/materials.h"
#include "server/materials/editable_points.h"
#include "server/materials/tile_estimate.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace relume::net {

// Not thread-safe.
class EditedMaterials {
  public:
    explicit EditedMaterials(std::shared_ptr<const materials::EditablePoints> points)
        : points_(std::move(points)), taken_up_(points_->materials().size()) {}

    // Whether the edits are not what they were.
    [[nodiscard]] bool set_edits(const wire::MaterialEdits& edits);
    // The materials that have an entry. Each takes up the curve that was edited last; diffuse
    // factors of all its curves are multiplied.
    [[nodiscard]] std::vector<materials::ShownMaterial> shown() const;

  private:
    const std::shared_ptr<const materials::EditablePoints> points_;
    wire::MaterialEdits edits_;
    std::vector<std::optional<std::size_t>> taken_up_;  // by material
};

}  // namespace relume::net
