// How the texels of an environment map cover the sphere. Formulas: protocol/README.md §1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace relume::light {

enum class Projection : std::uint8_t {
    lat_long,          // 2:1
    vertical_cross,    // 3:4
    horizontal_cross,  // 4:3
    angular_map,       // 1:1
    cubemap_strip      // 6:1 or 1:6
};

// The names used in flags and on the wire: "lat_long", "vertical_cross", …
[[nodiscard]] std::string_view to_string(Projection projection);
[[nodiscard]] std::optional<Projection> projection_from_string(std::string_view name);

// The only projection whose maps have this shape, if any. A single row or column of any other
// length than six is lat-long.
[[nodiscard]] std::optional<Projection> detect_projection(std::uint32_t width,
                                                          std::uint32_t height);

// Whether a map of this shape can be read so when the caller insists. As detect_projection, but
// lat-long then takes any shape: its texels are merely not square.
[[nodiscard]] bool accepts_shape(Projection projection,
                                 std::uint32_t width,
                                 std::uint32_t height);
// For messages: "vertical_cross (3:4)".
[[nodiscard]] std::string describe_shape(Projection projection);

}  // namespace relume::light
