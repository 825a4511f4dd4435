// Unit vectors in twice 16 bits: the octahedron |x| + |y| + |z| = 1, its lower half folded out
// over the square [Cigolle14]. Off by less than 7e-5.
#pragma once

#include <Imath/ImathVec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace relume::transport {

using OctahedralDirection = std::array<std::int16_t, 2>;

inline constexpr float kOctahedralScale = 32767;

namespace octahedral {

// From the lower half to what lies outside the diamond |x| + |y| = 1, and back.
[[nodiscard]] inline Imath::V2f folded(const Imath::V2f& p) {
    return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

}  // namespace octahedral

[[nodiscard]] inline OctahedralDirection octahedral_from_direction(const Imath::V3f& unit) {
    const float sum = std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z);
    Imath::V2f p(unit.x / sum, unit.y / sum);
    if (unit.z < 0) {
        p = octahedral::folded(p);
    }
    const auto rounded = [](float value) {
        return static_cast<std::int16_t>(
            std::lround(std::clamp(value, -1.0F, 1.0F) * kOctahedralScale));
    };
    return {rounded(p.x), rounded(p.y)};
}

// Unit for any pair of numbers.
[[nodiscard]] inline Imath::V3f direction_from_octahedral(const OctahedralDirection& packed) {
    Imath::V2f p(static_cast<float>(packed[0]) / kOctahedralScale,
                 static_cast<float>(packed[1]) / kOctahedralScale);
    const float z = 1 - std::abs(p.x) - std::abs(p.y);
    if (z < 0) {
        p = octahedral::folded(p);
    }
    return Imath::V3f(p.x, p.y, z).normalized();
}

}  // namespace relume::transport
