// Colours of other primaries than Rec. 709. Internal to protocol/light.
#pragma once

#include "protocol/light/map_centre.h"

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <optional>

namespace relume::light {

// CIE 1931 x, y.
struct Primaries {
    Imath::V2d red{0.64, 0.33};
    Imath::V2d green{0.30, 0.60};
    Imath::V2d blue{0.15, 0.06};
    Imath::V2d white{0.3127, 0.3290};
};

// Whether each coordinate is that of Rec. 709, as far as files state it.
[[nodiscard]] bool is_rec709(const Primaries& primaries);

// Linear colours to linear Rec. 709: rgb = matrix · colour. White stays white: where the white
// points differ they are adapted by Bradford's cones, as colour management does. Nothing when
// the primaries span no colours (a zero, a line, no numbers).
[[nodiscard]] std::optional<Imath::M33d> rec709_from(const Primaries& primaries);

// Parts of red, green and blue in the luminance of colours that rec709_from takes.
[[nodiscard]] Imath::V3d luminance_weights(const Primaries& primaries);

// CIE XYZ to linear Rec. 709 without adaptation: XYZ (0.9505, 1, 1.0891) is white.
[[nodiscard]] Imath::M33d rec709_from_xyz();

}  // namespace relume::light
