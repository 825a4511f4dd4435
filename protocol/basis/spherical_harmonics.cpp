#include "protocol/basis/spherical_harmonics.h"

#include <cmath>
#include <numbers>

namespace relume::basis {

std::uint32_t sh_band_from_index(std::size_t index) {
    std::uint32_t l = 0;
    while (sh_count(l + 1) <= index) {
        ++l;
    }
    return l;
}

void evaluate_sh(std::uint32_t order, const Imath::V3d& direction, std::span<double> values) {
    const auto [x, y, z] = direction;
    double diagonal = 1 / std::sqrt(4 * std::numbers::pi);  // N(m,m)·|P(m,m)| / sin^m θ
    double cosine = 1;                                      // sin^m θ · cos mφ
    double sine = 0;                                        // sin^m θ · sin mφ
    for (std::uint32_t m = 0; m < order; ++m) {
        const double scale = m == 0 ? 1 : std::numbers::sqrt2;
        const auto signed_m = static_cast<std::int32_t>(m);
        double before = 0;
        double legendre = diagonal;
        for (std::uint32_t l = m; l < order; ++l) {
            values[sh_index(l, signed_m)] = scale * legendre * cosine;
            if (m > 0) {
                values[sh_index(l, -signed_m)] = scale * legendre * sine;
            }
            const double m2 = 1.0 * m * m;
            const double l2 = 1.0 * l * l;
            const double next2 = (l + 1.0) * (l + 1.0);
            const double a = (4 * next2 - 1) / (next2 - m2);
            const double b = (l2 - m2) / (4 * l2 - 1);
            const double after = std::sqrt(a) * (z * legendre - std::sqrt(b) * before);
            before = legendre;
            legendre = after;
        }
        diagonal *= std::sqrt((2.0 * m + 3) / (2.0 * m + 2));
        const double turned = x * cosine - y * sine;
        sine = x * sine + y * cosine;
        cosine = turned;
    }
}

std::uint32_t sh_parity(std::size_t index) {
    const std::uint32_t l = sh_band_from_index(index);
    const auto m = static_cast<std::int64_t>(index) - std::int64_t{l} * l - l;
    const bool is_sine = m < 0;
    const auto size = static_cast<std::uint32_t>(is_sine ? -m : m);
    const std::uint32_t odd_in_x = (size + (is_sine ? 1U : 0U)) % 2;
    const std::uint32_t odd_in_y = is_sine ? 1 : 0;
    const std::uint32_t odd_in_z = (l + size) % 2;
    return odd_in_x | odd_in_y << 1U | odd_in_z << 2U;
}

}  // namespace relume::basis
