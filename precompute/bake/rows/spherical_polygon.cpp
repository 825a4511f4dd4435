#include "precompute/bake/rows/spherical_polygon.h"

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

// asin(s)/s; by its series where a texel's edge is short, which is nearly always.
double arc_over_chord(double s) {
    constexpr double kSeriesIsExactBelow = 0.1;
    if (s < kSeriesIsExactBelow) {
        const double q = s * s;
        return 1 + q * (1.0 / 6 + q * (3.0 / 40 + q * (15.0 / 336 + q * (105.0 / 3456))));
    }
    return std::asin(std::min(s, 1.0)) / s;
}

}  // namespace

SphericalPolygon::SphericalPolygon(const std::array<Imath::V3d, 4>& corners)
    : count_(corners.size()) {
    std::copy(corners.begin(), corners.end(), vertices_.begin());
}

void SphericalPolygon::clip(const Imath::V3d& normal) {
    std::array<Imath::V3d, kMaxVertices + 1> kept;
    std::size_t kept_count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Imath::V3d& a = vertices_[i];
        const Imath::V3d& b = vertices_[(i + 1) % count_];
        const double height_a = a.dot(normal);
        const double height_b = b.dot(normal);
        if (height_a >= 0) {
            kept[kept_count++] = a;
        }
        if ((height_a > 0 && height_b < 0) || (height_a < 0 && height_b > 0)) {
            kept[kept_count++] = a + (b - a) * (height_a / (height_a - height_b));
        }
        kept_count = std::min(kept_count, kMaxVertices);
    }
    std::copy_n(kept.begin(), kept_count, vertices_.begin());
    count_ = kept_count;
}

Imath::V3d SphericalPolygon::vector_irradiance() const {
    if (empty()) {
        return {0, 0, 0};
    }
    std::array<Imath::V3d, kMaxVertices> unit;
    Imath::V3d centre{0, 0, 0};
    for (std::size_t i = 0; i < count_; ++i) {
        unit[i] = vertices_[i].normalized();
        centre += unit[i];
    }
    Imath::V3d sum{0, 0, 0};
    for (std::size_t i = 0; i < count_; ++i) {
        const Imath::V3d normal = unit[i].cross(unit[(i + 1) % count_]);
        sum += normal * arc_over_chord(normal.length());
    }
    sum *= 0.5;
    return sum.dot(centre) < 0 ? -sum : sum;
}

}  // namespace relume::bake
