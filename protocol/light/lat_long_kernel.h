// What lookups in an environment cost most, many at once: where directions fall in a lat-long
// map, and how coarse a pixel sees it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace relume::light {

// Directions that are looked along at once.
inline constexpr std::size_t kLooksPerRun = 64;
using LookNumbers = std::array<float, kLooksPerRun>;

struct alignas(64) LookDirections {
    LookNumbers x{};
    LookNumbers y{};
    LookNumbers z{};

    void set(std::size_t i, float to_x, float to_y, float to_z) {
        x[i] = to_x;
        y[i] = to_y;
        z[i] = to_z;
    }
};

struct alignas(64) LatLongPoints {
    LookNumbers x;  // as MapPoint
    LookNumbers y;
    LookNumbers cos_latitude;
};

// What map_point_from_direction gives, to a few units in the last place, for the first `count`
// directions, of any non-zero length.
void lat_long_points(const LookDirections& directions,
                     std::size_t count,
                     LatLongPoints& points);

// How much of the way around the sphere pixels of these footprints span where they are, at most
// all of it; of as many as there are footprints.
void footprint_spans(std::span<const float> footprints_sr,
                     const LookNumbers& cos_latitudes,
                     LookNumbers& spans);

// log2 of the footprints' sides over a side, of as many as there are footprints, up to
// kLooksPerRun; anything where a footprint is not positive.
void footprint_levels(std::span<const float> footprints_sr,
                      float side_radians,
                      LookNumbers& levels);

}  // namespace relume::light
