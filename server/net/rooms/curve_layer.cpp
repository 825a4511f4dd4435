#include "server/net/rooms/curve_layer.h"

#include "server/view/tile_addend.h"

#include <cmath>
#include <utility>

namespace relume::net {

CurveLayer::CurveLayer(std::shared_ptr<const served::Scene> scene, std::size_t material_bytes)
    : scene_(std::move(scene)),
      edited_(scene_->editable_points()),
      layer_(scene_->editable_points(), material_bytes) {}

std::unique_ptr<view::View> CurveLayer::make_view() {
    return std::make_unique<view::AddedView>(scene_->make_view(), layer_);
}

RoomLayer::Change CurveLayer::set_state(const wire::RoomState& state,
                                        const NamedFinishes& /*finishes*/,
                                        RoomSignal& signal,
                                        bool light_is_new,
                                        std::vector<wire::ErrorMessage>& /*problems*/) {
    light_is_new_ = light_is_new_ || light_is_new;
    const bool edits_are_new = edited_.set_edits(state.materials);
    if (light_is_new_ && !state.materials.empty()) {
        layer_.set_light(*signal.cubemap(scene_->face_resolution()));
        light_is_new_ = false;
    }
    if (edits_are_new) {
        layer_.set_shown(edited_.shown());
    }
    return {.pixels = edits_are_new};
}

// What the light's image lacks and what materials lack are independent. Of an edit that is not
// to be seen yet nothing is known.
double CurveLayer::stated_error(double of_transport, double transport_norm) const {
    if (layer_.awaits_first_look()) {
        return 1;
    }
    const double error = layer_.error();
    if (error == 0) {
        return of_transport;
    }
    return transport_norm > 0 ? std::hypot(of_transport, error / transport_norm) : 1;
}

}  // namespace relume::net
