// The curves and diffuse colours of a room's materials as a signal.
#pragma once

#include "protocol/transport/curves_section.h"
#include "server/net/rooms/room_signal.h"

#include <span>
#include <vector>

namespace relume::net {

class CurveSignal final : public RoomSignal {
  public:
    // Of a scene's editable materials, in the order of the basis. Keeps a reference.
    explicit CurveSignal(std::span<const transport::CurveRecord> curves) : curves_(curves) {}

    [[nodiscard]] bool set_state(const wire::RoomState& state,
                                 const NamedEnvironments& environments,
                                 std::vector<wire::ErrorMessage>& problems) override;
    [[nodiscard]] std::span<const float> coefficients() const override { return coefficients_; }
    [[nodiscard]] const light::LightRig& rig() const override { return dark_; }

  private:
    const std::span<const transport::CurveRecord> curves_;
    const light::LightRig dark_;
    wire::MaterialEdits shown_;
    std::vector<float> coefficients_;
};

}  // namespace relume::net
