#include "protocol/tripling/haar_product.h"

#include "protocol/tripling/wavelet_square.h"

#include <array>
#include <cstddef>
#include <vector>

namespace relume::tripling {
namespace {

using Square3 = std::array<double, 3>;

Square3 square_of(std::uint32_t n, const WaveletSquare& square, std::span<const double> from) {
    Square3 wavelets{};
    for (std::size_t m = 0; m < 3; ++m) {
        wavelets[m] = from[coefficient_from_wavelet(n, square, kWaveletTypes[m])];
    }
    return wavelets;
}

// Parent sums of every square, without amplitudes: values over the square.
std::vector<double> values_over_squares(std::uint32_t n, std::span<const double> function) {
    std::vector<double> values(square_count(n));
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == 0) {
            values[0] = amplitude(n, 0) * function[0];
            continue;
        }
        const std::size_t parent = parent_square(i);
        const WaveletSquare square = square_from_index(parent);
        const Square3 wavelets = square_of(n, square, function);
        double sum = 0;
        for (std::size_t m = 0; m < 3; ++m) {
            sum += kQuadrantSigns[quadrant_in_parent(i)][m] * wavelets[m];
        }
        values[i] = values[parent] + amplitude(n, square.level) * sum;
    }
    return values;
}

}  // namespace

void haar_product(std::uint32_t n,
                  std::span<const double> e,
                  std::span<const double> f,
                  std::span<double> g) {
    const std::vector<double> e_values = values_over_squares(n, e);
    const std::vector<double> f_values = values_over_squares(n, f);
    // ∫ of the product of the wavelets of a square and of all finer ones within it.
    std::vector<double> products(square_count(n), 0);
    for (std::size_t i = square_count(n); i-- > 0;) {
        const WaveletSquare square = square_from_index(i);
        const double size = amplitude(n, square.level);
        const Square3 e_square = square_of(n, square, e);
        const Square3 f_square = square_of(n, square, f);
        const bool has_children = first_child(i) < square_count(n);
        for (std::size_t m = 0; m < 3; ++m) {
            const std::size_t next = (m + 1) % 3;
            const std::size_t last = (m + 2) % 3;
            double sum =
                e_square[m] * f_values[i] + f_square[m] * e_values[i] +
                size * (e_square[next] * f_square[last] + e_square[last] * f_square[next]);
            for (std::uint32_t quadrant = 0; has_children && quadrant < 4; ++quadrant) {
                sum += kQuadrantSigns[quadrant][m] * size * products[first_child(i) + quadrant];
            }
            g[coefficient_from_wavelet(n, square, kWaveletTypes[m])] = sum;
            products[i] += e_square[m] * f_square[m];
        }
        for (std::uint32_t quadrant = 0; has_children && quadrant < 4; ++quadrant) {
            products[i] += products[first_child(i) + quadrant];
        }
    }
    g[0] = amplitude(n, 0) * (e[0] * f[0] + (products.empty() ? 0 : products[0]));
}

}  // namespace relume::tripling
