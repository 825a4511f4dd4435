// What a room's scene is multiplied with, made of the room's state: its light, or the curves of
// its materials.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/net/rooms/named_environments.h"
#include "server/scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::net {

// Not thread-safe.
class RoomSignal {
  public:
    RoomSignal() = default;
    RoomSignal(const RoomSignal&) = delete;
    RoomSignal& operator=(const RoomSignal&) = delete;
    virtual ~RoomSignal() = default;

    // Makes the signal anew. False where it is what it was, never so at first. Adds what in the
    // state cannot be had to `problems`.
    [[nodiscard]] virtual bool set_state(const wire::RoomState& state,
                                         const NamedEnvironments& environments,
                                         std::vector<wire::ErrorMessage>& problems) = 0;
    // Of the scene's basis, planar [3][N].
    [[nodiscard]] virtual std::span<const float> coefficients() const = 0;
    // The light as texels of this resolution, of a scene that is lit; else null. Until the
    // signal is made anew.
    [[nodiscard]] virtual const light::LightCubemap* cubemap(
        std::uint32_t /*face_resolution*/) {
        return nullptr;
    }
    // The light that shows behind the scene; dark where the bake holds what shows there.
    [[nodiscard]] virtual const light::LightRig& rig() const = 0;
};

// Of the scene's kind. Keeps a reference to the scene.
[[nodiscard]] std::unique_ptr<RoomSignal> make_signal(const served::Scene& scene);

}  // namespace relume::net
