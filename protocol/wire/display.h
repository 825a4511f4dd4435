// From linear radiance to what a screen shows: exposure, tone curve, sRGB (protocol/README.md
// §3.2). The reference; a server or page may table or vectorise it.
#pragma once

#include "protocol/wire/room_state.h"

#include <cstdint>

namespace relume::wire {

// In [0, 1], before the transfer curve.
[[nodiscard]] float tone_mapped(float linear, const Display& display);
// sRGB transfer curve [IEC 61966-2-1] of a value in [0, 1].
[[nodiscard]] float srgb_from_linear(float linear);
// The 8-bit code value: ⌊255·srgb + ½⌋.
[[nodiscard]] std::uint8_t code_from_linear(float linear, const Display& display);

}  // namespace relume::wire
