#include "tests/lab/measures/image_error.h"

#include <algorithm>
#include <cmath>

namespace relume::lab {
namespace {

double square(double x) {
    return x * x;
}

double relative(double value, double reference) {
    if (reference == 0) {
        return value == 0 ? 0 : 1;
    }
    return value / reference;
}

}  // namespace

ImageError image_error(std::span<const float> image,
                       std::span<const float> reference,
                       std::uint32_t width) {
    const std::size_t row = 3 * std::size_t{width};
    double squared = 0;
    double squared_reference = 0;
    double gradient = 0;
    double gradient_reference = 0;
    double peak = 0;
    const auto difference = [&](std::size_t i) {
        return double{image[i]} - double{reference[i]};
    };
    for (std::size_t i = 0; i < reference.size(); ++i) {
        squared += square(difference(i));
        squared_reference += square(reference[i]);
        peak = std::max(peak, std::abs(difference(i)));
        if (i % row + 3 < row) {
            gradient += square(difference(i + 3) - difference(i));
            gradient_reference += square(double{reference[i + 3]} - double{reference[i]});
        }
        if (i + row < reference.size()) {
            gradient += square(difference(i + row) - difference(i));
            gradient_reference += square(double{reference[i + row]} - double{reference[i]});
        }
    }
    const double rms = std::sqrt(squared_reference / static_cast<double>(reference.size()));
    return {.l2 = relative(std::sqrt(squared), std::sqrt(squared_reference)),
            .h1 = relative(std::sqrt(squared + gradient),
                           std::sqrt(squared_reference + gradient_reference)),
            .peak = relative(peak, rms)};
}

double error_change(std::span<const float> image,
                    std::span<const float> reference,
                    std::span<float> previous_error) {
    double squared = 0;
    double squared_reference = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const float error = image[i] - reference[i];
        squared += square(double{error} - double{previous_error[i]});
        squared_reference += square(reference[i]);
        previous_error[i] = error;
    }
    return relative(std::sqrt(squared), std::sqrt(squared_reference));
}

}  // namespace relume::lab
