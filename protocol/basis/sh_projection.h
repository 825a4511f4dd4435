// Projection of a lighting cubemap onto spherical harmonics.
#pragma once

#include "protocol/basis/cubemap_projection.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::basis {

// A spherical harmonic is even or odd under each of the mirrors x, y, z → −x, −y, −z, and the
// cubemap is symmetric under them. So means over texels are kept for one octant alone (4.9 MB
// at order 20, n = 64). A projection first adds up the eight mirror images of a texel with the
// signs of every parity, and then takes an eighth of the products. Means are integrals by
// Gauss's rule with 4×4 points on each cell of a face that is cut into 64×64 cells or finer.
class ShProjection final : public CubemapProjection {
  public:
    // `basis` is of spherical harmonics.
    explicit ShProjection(const CubemapBasis& basis);

    void project_radiance(std::span<const float> texels,
                          std::span<float> coefficients) const override;
    void project_response(std::span<const float> texels,
                          std::span<float> coefficients) const override;
    void reconstruct_radiance(std::span<const float> coefficients,
                              std::span<float> texels) const override;

  private:
    static constexpr std::uint32_t kMirrors = 8;  // bit 0, 1, 2: x, y, z changes its sign

    // A texel of the octant x, y, z > 0.
    struct OctantTexel {
        std::array<std::uint32_t, kMirrors> index{};  // of its mirror images
        float solid_angle_sr = 0;
    };

    [[nodiscard]] std::span<const float> means(std::size_t octant_texel,
                                               std::uint32_t parity) const;
    template <typename Weight>
    void project(std::span<const float> texels,
                 std::span<float> coefficients,
                 Weight weight) const;

    std::vector<OctantTexel> octant_;
    // Coefficients in the order of their parity, and where each parity begins.
    std::vector<std::uint32_t> by_parity_;
    std::array<std::size_t, kMirrors + 1> first_{};
    std::vector<float> means_;  // [octant texels][coefficients by parity]
};

}  // namespace relume::basis
