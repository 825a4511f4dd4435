// Which way is up in a scene file.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::scene {

enum class UpAxis : std::uint8_t { y, z };

// From the axes of a file to Relume's, where +Y is up: a quarter turn about X where the file's
// up is +Z, so that what the file calls −Y is nearest to the viewer.
template <typename Number>
[[nodiscard]] Imath::Vec3<Number> y_up_from(UpAxis up, const Imath::Vec3<Number>& v) {
    return up == UpAxis::y ? v : Imath::Vec3<Number>(v.x, v.z, 0 - v.y);
}

template <typename Number>
[[nodiscard]] Imath::Vec3<Number> file_axes_from(UpAxis up, const Imath::Vec3<Number>& v) {
    return up == UpAxis::y ? v : Imath::Vec3<Number>(v.x, 0 - v.z, v.y);
}

}  // namespace relume::scene
