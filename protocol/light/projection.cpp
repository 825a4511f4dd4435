#include "protocol/light/projection.h"

#include <array>

namespace relume::light {
namespace {

struct Entry {
    Projection projection;
    std::string_view name;
    std::string_view shape;
};

constexpr std::array<Entry, 5> kEntries{{
    {Projection::lat_long, "lat_long", "2:1"},
    {Projection::vertical_cross, "vertical_cross", "3:4"},
    {Projection::horizontal_cross, "horizontal_cross", "4:3"},
    {Projection::angular_map, "angular_map", "1:1"},
    {Projection::cubemap_strip, "cubemap_strip", "6:1 or 1:6"},
}};

bool has_ratio(std::uint32_t width,
               std::uint32_t height,
               std::uint32_t across,
               std::uint32_t down) {
    return width % across == 0 && height % down == 0 && width / across == height / down;
}

bool has_own_shape(Projection projection, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) {
        return false;
    }
    switch (projection) {
        case Projection::lat_long:
            return has_ratio(width, height, 2, 1);
        case Projection::vertical_cross:
            return has_ratio(width, height, 3, 4);
        case Projection::horizontal_cross:
            return has_ratio(width, height, 4, 3);
        case Projection::angular_map:
            return width == height;
        case Projection::cubemap_strip:
            return has_ratio(width, height, 6, 1) || has_ratio(width, height, 1, 6);
    }
    return false;
}

}  // namespace

std::string_view to_string(Projection projection) {
    return kEntries.at(static_cast<std::size_t>(projection)).name;
}

std::optional<Projection> projection_from_string(std::string_view name) {
    for (const Entry& entry : kEntries) {
        if (entry.name == name) {
            return entry.projection;
        }
    }
    return std::nullopt;
}

std::optional<Projection> detect_projection(std::uint32_t width, std::uint32_t height) {
    // A single row or column has no other shape to go by; one of six texels may be a strip.
    if (width == 1 || height == 1) {
        return has_own_shape(Projection::cubemap_strip, width, height)
                   ? Projection::cubemap_strip
                   : Projection::lat_long;
    }
    for (const Entry& entry : kEntries) {
        if (has_own_shape(entry.projection, width, height)) {
            return entry.projection;
        }
    }
    return std::nullopt;
}

bool accepts_shape(Projection projection, std::uint32_t width, std::uint32_t height) {
    if (projection == Projection::lat_long) {
        return width > 0 && height > 0;
    }
    return has_own_shape(projection, width, height);
}

std::string describe_shape(Projection projection) {
    const Entry& entry = kEntries.at(static_cast<std::size_t>(projection));
    return std::string(entry.name) + " (" + std::string(entry.shape) + ")";
}

}  // namespace relume::light
