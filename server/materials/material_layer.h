// The materials of a room as people have edited them, under the room's light: what is added to
// an image that was relit with the materials as baked.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "server/materials/editable_points.h"
#include "server/materials/material_work.h"
#include "server/view/tile_addend.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::materials {

// Of one room's columns.
inline constexpr std::size_t kUsualMaterialBytes = std::size_t{512} << 20;

// The image is T·L + Σ_m (T'_m(L)·c_m − T'_m(L)·c_m as baked, and diffuse parts likewise):
// exact for the light that reaches a material straight, while light that comes by way of other
// surfaces meets it as baked. A material without an edit adds nothing, to the last bit.
//
// Not thread-safe, but for add_to_tile, which may not run beside the others. Work is spread
// over the caller's arena. A layer that is whole depends on light and edits alone.
class MaterialLayer final : public view::TileAddend {
  public:
    // Columns take at most about `most_bytes`; materials that would need more stay at a glance.
    MaterialLayer(std::shared_ptr<const EditablePoints> points, std::size_t most_bytes);

    [[nodiscard]] const EditablePoints& points() const { return *points_; }
    // What is shown stays until there is better.
    void set_light(const light::LightCubemap& cubemap);
    // At most one entry a material; materials without one are as baked. Columns of what was
    // shown under this light are kept while there is room.
    void set_shown(std::vector<ShownMaterial> shown);

    // Works for about so long, on one batch of tiles at least, or until nothing is left to do.
    // True where what is shown has changed.
    bool advance(double milliseconds);
    // Whether the last edit is not to be seen yet.
    [[nodiscard]] bool awaits_first_look() const { return awaits_first_look_; }
    // Whether advance has something left to do.
    [[nodiscard]] bool has_work() const;
    // Whether all that is shown has columns, by which its curves can be dragged.
    [[nodiscard]] bool has_columns() const;
    // Whether all that is shown is of whole columns.
    [[nodiscard]] bool is_whole() const;
    // Tiles of materials whose columns are not whole.
    [[nodiscard]] std::size_t tiles_to_come() const;
    // Estimated length of the difference from what is shown to the whole, over all pixels and
    // colours.
    [[nodiscard]] double error() const;
    [[nodiscard]] std::size_t bytes() const;

    void add_to_tile(std::uint32_t tile, float* first, std::size_t row_floats) const override;

  private:
    using Works = std::vector<std::unique_ptr<MaterialWork>>;

    [[nodiscard]] std::unique_ptr<MaterialWork> work_for(ShownMaterial shown, Works& before);
    // Expects that there is work.
    bool work_a_batch();
    void forget_what_does_not_fit();
    [[nodiscard]] bool may_grow() const;

    const std::shared_ptr<const EditablePoints> points_;
    const std::size_t most_bytes_;
    std::shared_ptr<const PresentLight> light_;
    Works shown_;
    Works kept_;  // the one shown last at the end
    KnownErrors errors_;
    bool awaits_first_look_ = false;
};

}  // namespace relume::materials
