// A colour that is added and multiplied at once, with a fourth number beside it.
#pragma once

#include <cstring>

namespace relume::view {

using Rgb = float __attribute__((vector_size(4 * sizeof(float))));

inline Rgb load_rgb(const float* from) {
    Rgb rgb;
    std::memcpy(&rgb, from, sizeof(rgb));
    return rgb;
}
inline void store_rgb(const Rgb& rgb, float* to) {
    std::memcpy(to, &rgb, sizeof(rgb));
}

}  // namespace relume::view
