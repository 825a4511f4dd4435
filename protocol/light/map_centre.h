// Where the centre of an environment map looks. Tools differ in it; README.md names them.
#pragma once

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <cstdint>
#include <optional>
#include <string_view>

namespace relume::light {

// As a source direction (protocol/README.md §1). Up stays up, but for the last two: there the
// map is tilted about its right, so that its upper edge comes to lie at +Z or −Z.
enum class MapCentre : std::uint8_t {
    negative_z,
    positive_z,
    positive_x,
    negative_x,
    positive_y,
    negative_y
};

// The names used in flags and on the wire: "-z", "+z", "+x", "-x", "+y", "-y".
[[nodiscard]] std::string_view to_string(MapCentre centre);
[[nodiscard]] std::optional<MapCentre> map_centre_from_string(std::string_view name);
// All of them, for messages.
[[nodiscard]] std::string_view map_centre_names();

// Columns are where +X, +Y and +Z of a map whose centre looks to −Z come to lie: source
// direction = matrix · direction by the formulas of protocol/README.md §1, the vector being a
// column. Entries are 0, 1 and −1.
[[nodiscard]] Imath::M33f turn_of_centre(MapCentre centre);

// matrix · v for a column v; Imath multiplies rows.
template <typename Number>
[[nodiscard]] Imath::Vec3<Number> product(const Imath::Matrix33<Number>& m,
                                          const Imath::Vec3<Number>& v) {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

}  // namespace relume::light
