// The vector irradiance of a small spherical polygon: ∫ ω dω over it [Lambert 1760; Arvo95].
//
// Its dot product with a normal is the exact ∫ cos θ dω as long as all of the polygon lies
// above the normal's horizon; what crosses the horizon is clipped first.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>

namespace relume::bake {

// Convex, smaller than a hemisphere, counter-clockwise or clockwise; vertices of any length.
class SphericalPolygon {
  public:
    // A texel's four corners clipped by two planes.
    static constexpr std::size_t kMaxVertices = 6;

    explicit SphericalPolygon(const std::array<Imath::V3d, 4>& corners);

    // Keeps what is on the side of `normal`, by Sutherland and Hodgman.
    void clip(const Imath::V3d& normal);
    [[nodiscard]] bool empty() const { return count_ < 3; }
    [[nodiscard]] std::size_t vertex_count() const { return count_; }

    // ∫ ω dω; points into the polygon whatever its orientation. Zero when empty.
    [[nodiscard]] Imath::V3d vector_irradiance() const;

  private:
    std::array<Imath::V3d, kMaxVertices> vertices_;
    std::size_t count_ = 0;
};

}  // namespace relume::bake
