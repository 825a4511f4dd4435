#include "tests/support/dark_tenth_error.h"

#include "tests/support/tiny_transport.h"

#include <algorithm>
#include <cmath>

namespace relume::test {

using transport::kBlockSize;
using transport::kColours;

double dark_tenth_error(const transport::Transport& transport,
                        std::span<const float> shown_sums,
                        std::vector<double> exact_sums) {
    std::vector<double> shown(shown_sums.begin(), shown_sums.end());
    receivers_from_sums(shown);
    receivers_from_sums(exact_sums);
    struct Pixel {
        double value = 0;
        double error = 0;
    };
    const auto tint = transport.tint();
    const auto coverage = transport.coverage();
    std::vector<Pixel> pixels;
    for (std::size_t receiver = 0; receiver < coverage.size(); ++receiver) {
        if (coverage[receiver] <= 0) {
            continue;
        }
        Pixel pixel;
        const std::size_t first =
            receiver / kBlockSize * kColours * kBlockSize + receiver % kBlockSize;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t i = first + c * kBlockSize;
            const double value = exact_sums[i] * double{tint[i]};
            const double error = shown[i] * double{tint[i]} - value;
            pixel.value += value * value;
            pixel.error += error * error;
        }
        pixels.push_back(pixel);
    }
    const auto tenth = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 10);
    std::nth_element(pixels.begin(), tenth, pixels.end(),
                     [](const Pixel& a, const Pixel& b) { return a.value < b.value; });
    double value = 0;
    double error = 0;
    for (auto pixel = pixels.begin(); pixel != tenth; ++pixel) {
        value += pixel->value;
        error += pixel->error;
    }
    return std::sqrt(error / value);
}

}  // namespace relume::test
