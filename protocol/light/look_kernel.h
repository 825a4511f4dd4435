// The inner loop of EnvironmentMap::radiances: many points of one level at once.
#pragma once

#include "protocol/light/lat_long_kernel.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::light {

// A level of an environment's pyramid as EnvironmentMap::Level holds it, faces stacked.
struct LookLevel {
    const float* rgb;
    std::uint32_t width;  // of a face
    std::uint32_t height;
};

// What is looked at: places as MapPoint has them, and how many texels side by side a pixel
// spans there, as a part of the width.
struct alignas(64) LookPoints {
    LatLongPoints places;
    std::array<std::uint32_t, kLooksPerRun> faces{};
    LookNumbers spans{};
};

// Where between four texels a point lies: the upper left one as an offset into rgb, and how far
// from it to the next. kNotInside where four do not lie inside the face side by side, or a
// pixel spans more than one: such points need more than this.
struct alignas(64) LookTaps {
    static constexpr std::int32_t kNotInside = -1;
    std::array<std::int32_t, kLooksPerRun> offsets;
    LookNumbers x_fractions;
    LookNumbers y_fractions;
};

// Of the first `count` points; whether all of them lie inside.
bool find_taps(const LookLevel& level,
               const LookPoints& points,
               std::size_t count,
               LookTaps& taps);

// Adds to each radiance its weight times the bilinear mean of its four texels, where these lie
// inside and the weight is not 0. The same bits on every machine.
void add_taps(const LookLevel& level,
              const LookTaps& taps,
              const LookNumbers& weights,
              std::span<Imath::V3f> radiances);

}  // namespace relume::light
