// A transport opened for relighting.
#pragma once

#include "protocol/basis/cubemap_projection.h"
#include "protocol/transport/transport.h"
#include "server/engine/operators/stored_operator.h"
#include "server/engine/workspace.h"
#include "server/materials/editable_points.h"
#include "server/scene/scene_bounds.h"
#include "server/scene/scene_part.h"
#include "server/triple/lit_surface.h"
#include "server/view/view.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relume::view {
class DrawnSurface;
class GivenRadiance;
}

namespace relume::served {

// What everybody who relights one scene shares: how a light becomes a signal, the operator that
// takes the signal to receivers, and views, which make images of them. Immutable but for what
// its workspace lends; safe to share between threads.
class Scene {
  public:
    // Arranges the transport for whole products, in parallel.
    explicit Scene(std::shared_ptr<const transport::Transport> transport);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    [[nodiscard]] const transport::Transport& transport() const { return *transport_; }
    // Whether the signal is light. Otherwise it is curves, whose light is frozen.
    [[nodiscard]] bool is_lit() const { return projection_ != nullptr; }
    // From a cubemap of light of resolution `face_resolution()` to a signal. Of a scene that is
    // lit.
    [[nodiscard]] const basis::CubemapProjection& projection() const { return *projection_; }
    [[nodiscard]] std::uint32_t face_resolution() const {
        return projection_->basis().face_resolution();
    }
    // That people edit. Of a scene that is not lit they are the signal, in the order of the
    // basis; of one that is lit, those of `editable_points`.
    [[nodiscard]] std::span<const transport::CurveRecord> curves() const;
    // Of a scene that is lit, and whose materials people edit beside its light; else null.
    [[nodiscard]] const std::shared_ptr<const materials::EditablePoints>& editable_points()
        const {
        return editable_points_;
    }
    // Of a mesh whose vertices know what they see of the light, so that its parts may be given
    // other materials; else null. Parts are the materials of the surface, in their order.
    [[nodiscard]] const std::shared_ptr<const triple::LitSurface>& lit_surface() const {
        return lit_surface_;
    }
    [[nodiscard]] std::span<const ScenePart> parts() const { return parts_; }
    [[nodiscard]] const engine::StoredOperator& stored_operator() const { return *operator_; }
    [[nodiscard]] const engine::ColumnTable& columns() const { return operator_->columns(); }
    // What sessions over the scene are made with.
    [[nodiscard]] const std::shared_ptr<const engine::Workspace>& workspace() const {
        return workspace_;
    }
    // Where a view looks from as it begins.
    [[nodiscard]] const view::Look& beginning() const { return beginning_; }
    // Whether it can look from elsewhere, and at images of other sizes.
    [[nodiscard]] bool view_can_move() const { return surface_ != nullptr; }
    // Where the view can move: all that there is to see.
    [[nodiscard]] const std::optional<SceneBounds>& bounds() const { return bounds_; }
    // A view of one's own, as it begins.
    // Where the scene has a lit surface, `given` may be the radiance of some of its parts; it
    // outlives the view.
    [[nodiscard]] std::unique_ptr<view::View> make_view(
        const view::GivenRadiance* given = nullptr) const;
    // The size of the images that a view begins with.
    [[nodiscard]] transport::TileGrid image() const {
        return {.width = beginning_.width, .height = beginning_.height};
    }
    // The image of a view as it begins (view/view.h).
    void write_image(std::span<const float> sums, std::span<float> rgb) const;
    // Bytes of memory.
    [[nodiscard]] std::uint64_t bytes() const;

  private:
    std::shared_ptr<const transport::Transport> transport_;
    std::shared_ptr<const basis::CubemapProjection> projection_;  // null where it is not lit
    std::shared_ptr<const engine::StoredOperator> operator_;
    std::shared_ptr<const engine::Workspace> workspace_;
    std::shared_ptr<const view::DrawnSurface> surface_;  // of a mesh
    std::shared_ptr<const triple::LitSurface> lit_surface_;
    std::vector<ScenePart> parts_;
    std::shared_ptr<const materials::EditablePoints> editable_points_;
    std::optional<SceneBounds> bounds_;
    view::Look beginning_;
};

}  // namespace relume::served
