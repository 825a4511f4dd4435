// A file in MERL's layout, of a BRDF that is a formula.
#pragma once

#include "precompute/factors/merl_brdf.h"

#include <Imath/ImathVec.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>
#include <vector>

namespace relume::test {

using Formula = std::function<Imath::V3f(const Imath::V3f& wi, const Imath::V3f& wo)>;

// wi and wo from the angles of the half vector, whose azimuth is 0, and of the difference.
struct PairOfDirections {
    Imath::V3f wi, wo;

    PairOfDirections(double theta_half, double theta_difference, double phi_difference) {
        const double x = std::sin(theta_difference) * std::cos(phi_difference);
        const double y = std::sin(theta_difference) * std::sin(phi_difference);
        const double z = std::cos(theta_difference);
        const double c = std::cos(theta_half);
        const double s = std::sin(theta_half);
        wi = Imath::V3f(Imath::V3d(c * x + s * z, y, -s * x + c * z));
        wo = Imath::V3f(Imath::V3d(-c * x + s * z, -y, s * x + c * z));
    }
};

// The values at the middles of the cells; −1 where a direction lies below the horizon.
inline std::vector<std::byte> merl_file(const Formula& formula) {
    std::vector<std::byte> bytes(factors::MerlBrdf::kFileBytes);
    const std::int32_t counts[]{90, 90, 180};
    std::memcpy(bytes.data(), counts, sizeof(counts));
    const double scales[]{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
    std::size_t cell = 0;
    for (int h = 0; h < 90; ++h) {
        const double theta_half = std::numbers::pi / 2 * std::pow((h + 0.5) / 90, 2);
        for (int d = 0; d < 90; ++d) {
            for (int p = 0; p < 180; ++p, ++cell) {
                const PairOfDirections pair(theta_half, (d + 0.5) * std::numbers::pi / 180,
                                            (p + 0.5) * std::numbers::pi / 180);
                const bool is_above = pair.wi.z > 0 && pair.wo.z > 0;
                const Imath::V3f value = is_above ? formula(pair.wi, pair.wo) : Imath::V3f(-1);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double stored = value[static_cast<int>(c)] / scales[c];
                    std::memcpy(
                        &bytes[12 + (c * factors::MerlBrdf::kCells + cell) * sizeof(double)],
                        &stored, sizeof(double));
                }
            }
        }
    }
    return bytes;
}

}  // namespace relume::test
