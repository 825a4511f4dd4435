// Directions for tests of BRDFs.
#pragma once

#include "protocol/brdf/directions.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <random>
#include <vector>

namespace relume::brdf {

class RandomDirections {
  public:
    explicit RandomDirections(unsigned seed) : random_(seed) {}

    [[nodiscard]] Imath::V3f on_sphere() {
        Imath::V3f direction(0, 0, 0);
        while (direction.length() < 1e-3F) {
            direction = {normal_(random_), normal_(random_), normal_(random_)};
        }
        return direction.normalized();
    }
    [[nodiscard]] Imath::V3f above_horizon() {
        Imath::V3f direction = on_sphere();
        direction.z = std::fabs(direction.z) + 1e-6F;
        return direction.normalized();
    }

  private:
    std::mt19937 random_;
    std::normal_distribution<float> normal_;
};

// Directions one by one, and the same in planes.
struct DirectionList {
    std::vector<float> x, y, z;

    explicit DirectionList(std::size_t count) : x(count), y(count), z(count) {}
    void add(const Imath::V3f& d) {
        x.push_back(d.x);
        y.push_back(d.y);
        z.push_back(d.z);
    }
    [[nodiscard]] Imath::V3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] Directions planes() const { return {x, y, z}; }
};

}  // namespace relume::brdf
