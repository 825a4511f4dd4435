#include "server/net/rooms/room_signal.h"

#include "server/net/rooms/curve_signal.h"
#include "server/net/rooms/light_signal.h"

namespace relume::net {

std::unique_ptr<RoomSignal> make_signal(const served::Scene& scene) {
    if (scene.is_lit()) {
        return std::make_unique<LightSignal>(scene.projection());
    }
    return std::make_unique<CurveSignal>(scene.curves());
}

}  // namespace relume::net
