#include "tests/stability/band_norms.h"

#include <algorithm>
#include <cmath>

namespace relume::stability {

std::vector<double> band_l1(const served::Scene& scene,
                            std::span<const float> a,
                            std::span<const float> b) {
    std::vector<double> sums(scene.columns().band_count());
    const std::size_t count = scene.columns().count();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double other = b.empty() ? 0.0 : double{b[i]};
        sums[scene.columns().bands()[i % count]] += std::abs(double{a[i]} - other);
    }
    return sums;
}

double worst_band_residual(const served::Scene& scene,
                           std::span<const float> target,
                           std::span<const float> approximation) {
    const std::vector<double> wanted = band_l1(scene, target);
    const std::vector<double> missing = band_l1(scene, target, approximation);
    double worst = 0;
    for (std::size_t band = 0; band < wanted.size(); ++band) {
        if (wanted[band] > 0) {
            worst = std::max(worst, missing[band] / wanted[band]);
        }
    }
    return worst;
}

}  // namespace relume::stability
