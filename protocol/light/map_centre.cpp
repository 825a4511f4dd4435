#include "protocol/light/map_centre.h"

#include <array>
#include <cstddef>

namespace relume::light {
namespace {

struct Entry {
    std::string_view name;
    Imath::M33f turn;
};

const std::array<Entry, 6>& entries() {
    static const std::array<Entry, 6> all{{
        {"-z", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"+z", {-1, 0, 0, 0, 1, 0, 0, 0, -1}},
        {"+x", {0, 0, -1, 0, 1, 0, 1, 0, 0}},
        {"-x", {0, 0, 1, 0, 1, 0, -1, 0, 0}},
        {"+y", {1, 0, 0, 0, 0, -1, 0, 1, 0}},
        {"-y", {1, 0, 0, 0, 0, 1, 0, -1, 0}},
    }};
    return all;
}

}  // namespace

std::string_view to_string(MapCentre centre) {
    return entries().at(static_cast<std::size_t>(centre)).name;
}

std::optional<MapCentre> map_centre_from_string(std::string_view name) {
    for (std::size_t i = 0; i < entries().size(); ++i) {
        if (entries().at(i).name == name) {
            return static_cast<MapCentre>(i);
        }
    }
    return std::nullopt;
}

std::string_view map_centre_names() {
    return "-z, +z, +x, -x, +y or -y";
}

Imath::M33f turn_of_centre(MapCentre centre) {
    return entries().at(static_cast<std::size_t>(centre)).turn;
}

}  // namespace relume::light
