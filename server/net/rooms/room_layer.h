// What people edit in a room besides its light, where the scene has what that takes.
#pragma once

#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/net/rooms/named_finishes.h"
#include "server/net/rooms/room_signal.h"
#include "server/scene/scene.h"
#include "server/view/view.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::net {

// It adds to the image that the transport gives, or takes the place of parts of it, and is
// worked out from one slice to the next. Not thread-safe; work is spread over the caller's
// arena.
class RoomLayer {
  public:
    RoomLayer() = default;
    RoomLayer(const RoomLayer&) = delete;
    RoomLayer& operator=(const RoomLayer&) = delete;
    virtual ~RoomLayer() = default;

    // A view of the scene with this layer in it; the layer outlives it.
    [[nodiscard]] virtual std::unique_ptr<view::View> make_view() = 0;

    struct Change {
        bool pixels = false;  // of what is shown now
        bool parts = false;   // which parts of the image are the layer's
    };
    // Takes from the state what is edited here. `light_is_new`: the signal has changed since
    // the call before. Adds what cannot be had to `problems`.
    [[nodiscard]] virtual Change set_state(const wire::RoomState& state,
                                           const NamedFinishes& finishes,
                                           RoomSignal& signal,
                                           bool light_is_new,
                                           std::vector<wire::ErrorMessage>& problems) = 0;
    // The view looks from elsewhere, or parts have changed.
    virtual void set_view(const view::View& /*view*/) {}

    // Works for about so long; true where pixels have changed.
    virtual bool advance(double milliseconds) = 0;
    [[nodiscard]] virtual bool has_work() const = 0;
    // Whether an edit is not to be seen yet, and images wait.
    [[nodiscard]] virtual bool awaits_first_look() const = 0;
    // Whether what is shown depends on the state alone.
    [[nodiscard]] virtual bool is_exact() const = 0;
    // Whether pixels show the transport too.
    [[nodiscard]] virtual bool shows_transport() const { return true; }
    // Relative L2 of the whole image, of which the transport's is off by `of_transport` and has
    // an estimated length of `transport_norm`.
    [[nodiscard]] virtual double stated_error(double of_transport,
                                              double transport_norm) const = 0;
    // What is still to be made: tiles, vertices.
    [[nodiscard]] virtual std::size_t remaining() const = 0;
};

// The layer that rooms of the scene have; null for scenes of which light alone is edited, or
// curves alone. `material_bytes` bounds what columns of edited materials take.
[[nodiscard]] std::unique_ptr<RoomLayer> make_layer(std::shared_ptr<const served::Scene> scene,
                                                    std::size_t material_bytes);

}  // namespace relume::net
