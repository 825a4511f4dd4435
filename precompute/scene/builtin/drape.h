// A cloth that was let fall over something: its folds are those of a simulation, the same on
// every run.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace relume::scene {

// Points of a cloth in rows of equal length, [count][count].
struct Cloth {
    std::uint32_t count = 0;
    std::vector<Imath::V3f> points;

    [[nodiscard]] const Imath::V3f& at(std::uint32_t row, std::uint32_t column) const {
        return points[row * count + column];
    }
};

struct ClothDrop {
    float side = 1;           // of the square cloth, in metres
    float height = 1;         // where it lies, flat, before it falls; its middle is above 0
    float slack = 0;          // how much longer its threads are than it is laid out
    std::uint32_t count = 2;  // of points along a side
    std::uint32_t steps = 0;  // of a two-hundredth of a second
    std::uint32_t iterations = 0;  // over all threads in a step
    std::uint64_t seed = 0;        // of the small waves that it falls with
};

// Where a point has to go that has sunk into what the cloth falls on; the point itself where it
// has not.
using PushOut = std::function<Imath::V3f(const Imath::V3f&)>;

// Threads along, across and aslant keep their lengths [Muller07]; longer ones resist bending.
// What touches is held by friction. The cloth does not collide with itself.
[[nodiscard]] Cloth draped_cloth(const ClothDrop& drop, const PushOut& push_out);

// A cloth of so many points along a side on the uniform cubic B-spline of the points: smooth,
// and within their hull.
[[nodiscard]] Cloth smoothed_cloth(const Cloth& cloth, std::uint32_t count);

}  // namespace relume::scene
