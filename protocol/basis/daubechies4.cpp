#include "protocol/basis/daubechies4.h"

#include <algorithm>
#include <array>

namespace relume::basis {
namespace {

constexpr double kRoot3 = 1.7320508075688772935;
constexpr double kScale = 0.17677669529663688110;  // 1/(4√2)
constexpr std::array<double, 4> kAverage{(1 + kRoot3) * kScale, (3 + kRoot3) * kScale,
                                         (3 - kRoot3) * kScale, (1 - kRoot3) * kScale};
constexpr std::array<double, 4> kDifference{kAverage[3], -kAverage[2], kAverage[1],
                                            -kAverage[0]};

using Values = std::array<double, kDaubechies4Size>;

}  // namespace

void daubechies4_forward(std::span<const float, kDaubechies4Size> samples,
                         std::span<float, kDaubechies4Size> coefficients) {
    Values values;
    std::copy(samples.begin(), samples.end(), values.begin());
    for (std::size_t n = kDaubechies4Size; n > 1; n /= 2) {
        const Values whole = values;
        for (std::size_t i = 0; i < n / 2; ++i) {
            double average = 0;
            double difference = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const double value = whole[(2 * i + k) % n];
                average += kAverage[k] * value;
                difference += kDifference[k] * value;
            }
            values[i] = average;
            values[n / 2 + i] = difference;
        }
    }
    std::transform(values.begin(), values.end(), coefficients.begin(),
                   [](double value) { return static_cast<float>(value); });
}

void daubechies4_inverse(std::span<const float, kDaubechies4Size> coefficients,
                         std::span<float, kDaubechies4Size> samples) {
    Values values;
    std::copy(coefficients.begin(), coefficients.end(), values.begin());
    for (std::size_t n = 2; n <= kDaubechies4Size; n *= 2) {
        Values whole{};
        for (std::size_t i = 0; i < n / 2; ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                whole[(2 * i + k) % n] +=
                    kAverage[k] * values[i] + kDifference[k] * values[n / 2 + i];
            }
        }
        std::copy_n(whole.begin(), n, values.begin());
    }
    std::transform(values.begin(), values.end(), samples.begin(),
                   [](double value) { return static_cast<float>(value); });
}

}  // namespace relume::basis
