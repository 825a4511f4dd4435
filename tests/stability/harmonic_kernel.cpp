#include "tests/stability/harmonic_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::stability {

HarmonicKernel::HarmonicKernel(std::uint32_t order) : order_(order) {
    constexpr int kAngles = 20'000;
    constexpr double kStep = std::numbers::pi / kAngles;
    lowest_ = at(-1);
    for (int i = 0; i < kAngles; ++i) {
        const double angle = kStep * (i + 0.5);
        const double value = at(std::cos(angle));
        lowest_ = std::min(lowest_, value);
        l1_ += std::abs(value) * 2 * std::numbers::pi * std::sin(angle) * kStep;
    }
}

double HarmonicKernel::at(double cosine) const {
    double sum = 0;
    double before = 0;
    double legendre = 1;
    for (std::uint32_t l = 0; l < order_; ++l) {
        sum += (2 * l + 1) * legendre;
        const double next = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
        before = legendre;
        legendre = next;
    }
    return sum / (4 * std::numbers::pi);
}

}  // namespace relume::stability
