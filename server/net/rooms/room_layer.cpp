#include "server/net/rooms/room_layer.h"

#include "server/net/rooms/curve_layer.h"
#include "server/net/rooms/finish_layer.h"

#include <utility>

namespace relume::net {

std::unique_ptr<RoomLayer> make_layer(std::shared_ptr<const served::Scene> scene,
                                      std::size_t material_bytes) {
    if (scene->editable_points()) {
        return std::make_unique<CurveLayer>(std::move(scene), material_bytes);
    }
    if (scene->lit_surface()) {
        return std::make_unique<FinishLayer>(std::move(scene));
    }
    return nullptr;
}

}  // namespace relume::net
