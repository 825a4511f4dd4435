#include "tests/lab/image_error.h"

#include <algorithm>
#include <cmath>

namespace relume::lab {
namespace {

double square(double x) {
    return x * x;
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
    const auto count = static_cast<double>(reference.size());
    return {.l2 = std::sqrt(squared / squared_reference),
            .h1 = std::sqrt((squared + gradient) / (squared_reference + gradient_reference)),
            .peak = peak / std::sqrt(squared_reference / count)};
}

}  // namespace relume::lab
