// The light of a room as a signal: environments, turned and blended, and round lights.
#pragma once

#include "protocol/basis/cubemap_projection.h"
#include "protocol/light/light_cubemap.h"
#include "server/net/rooms/room_signal.h"

#include <optional>

namespace relume::net {

class LightSignal final : public RoomSignal {
  public:
    // Keeps a reference.
    explicit LightSignal(const basis::CubemapProjection& projection)
        : projection_(projection) {}

    [[nodiscard]] bool set_state(const wire::RoomState& state,
                                 const NamedEnvironments& environments,
                                 std::vector<wire::ErrorMessage>& problems) override;
    [[nodiscard]] std::span<const float> coefficients() const override { return coefficients_; }
    [[nodiscard]] const light::LightCubemap* cubemap(std::uint32_t face_resolution) override;
    [[nodiscard]] const light::LightRig& rig() const override { return rig_; }

  private:
    const basis::CubemapProjection& projection_;
    light::LightRig rig_;
    NamedEnvironments environments_;
    light::LightCubemap cubemap_;
    light::LightCubemap other_cubemap_;  // of the resolution asked for last; 0: none
    std::vector<float> coefficients_;
};

}  // namespace relume::net
