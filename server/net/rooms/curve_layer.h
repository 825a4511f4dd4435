// Curves of materials, edited beside the light of a scene of kind `image`.
#pragma once

#include "server/materials/material_layer.h"
#include "server/net/rooms/edited_materials.h"
#include "server/net/rooms/room_layer.h"

namespace relume::net {

class CurveLayer final : public RoomLayer {
  public:
    // Of a scene with editable points. Columns take at most about so many bytes.
    CurveLayer(std::shared_ptr<const served::Scene> scene, std::size_t material_bytes);

    [[nodiscard]] std::unique_ptr<view::View> make_view() override;
    // A layer that shows nothing is not told of the light.
    [[nodiscard]] Change set_state(const wire::RoomState& state,
                                   const NamedFinishes& finishes,
                                   RoomSignal& signal,
                                   bool light_is_new,
                                   std::vector<wire::ErrorMessage>& problems) override;
    bool advance(double milliseconds) override { return layer_.advance(milliseconds); }
    [[nodiscard]] bool has_work() const override { return layer_.has_work(); }
    [[nodiscard]] bool awaits_first_look() const override { return layer_.awaits_first_look(); }
    [[nodiscard]] bool is_exact() const override { return layer_.is_whole(); }
    [[nodiscard]] double stated_error(double of_transport,
                                      double transport_norm) const override;
    [[nodiscard]] std::size_t remaining() const override { return layer_.tiles_to_come(); }

  private:
    const std::shared_ptr<const served::Scene> scene_;
    EditedMaterials edited_;
    materials::MaterialLayer layer_;
    bool light_is_new_ = true;
};

}  // namespace relume::net
