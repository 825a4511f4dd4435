#include "precompute/factors/term_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace relume::factors {
namespace {

constexpr double kPi = std::numbers::pi;
// Between so many columns a wave is bilinear to 2·10⁻³ of itself.
constexpr std::uint32_t kColumnsPerWave = 48;

// Values of g and h on the table's directions: functions of (term, row, column) and of (term,
// lobe, row, column).
template <typename G, typename H>
brdf::FactoredBrdf tabulated(std::string name,
                             std::uint32_t terms,
                             std::span<const double> lobe_weights,
                             const PolarGrid& grid,
                             std::uint32_t columns,
                             const G& g,
                             const H& h) {
    const auto lobes = static_cast<std::uint32_t>(lobe_weights.size());
    const brdf::TableShape g_shape{grid.rows(), columns, terms};
    const brdf::TableShape h_shape{grid.rows(), columns, terms * lobes};
    std::vector<float> g_values(g_shape.value_count());
    std::vector<float> h_values(h_shape.value_count());
    for (std::uint32_t k = 0; k < terms; ++k) {
        double mean_square = 0;  // Σ_l w_l² h², over the hemisphere
        for (std::uint32_t row = 0; row < grid.rows(); ++row) {
            for (std::uint32_t column = 0; column < columns; ++column) {
                for (std::uint32_t l = 0; l < lobes; ++l) {
                    const double value = lobe_weights[l] * h(k, l, row, column);
                    mean_square += value * value * grid.weights[row] * 2 / columns;
                }
            }
        }
        const double scale = mean_square > 0 ? std::sqrt(mean_square) : 1.0;
        for (std::uint32_t row = 0; row < grid.rows(); ++row) {
            for (std::uint32_t column = 0; column < columns; ++column) {
                const std::size_t at = std::size_t{row} * columns + column;
                g_values[at * terms + k] = static_cast<float>(g(k, row, column) * scale);
                for (std::uint32_t l = 0; l < lobes; ++l) {
                    h_values[(at * terms + k) * lobes + l] =
                        static_cast<float>(h(k, l, row, column) / scale);
                }
            }
        }
    }
    return {.name = std::move(name),
            .terms = terms,
            .lobes = lobes,
            .g = {g_shape, std::move(g_values)},
            .h = {h_shape, std::move(h_values)}};
}

}  // namespace

brdf::FactoredBrdf brdf_from_terms(std::string name,
                                   std::span<const AzimuthalTerm> terms,
                                   std::span<const double> lobe_weights,
                                   const PolarGrid& grid) {
    std::uint32_t highest = 0;
    for (const AzimuthalTerm& term : terms) {
        highest = std::max(highest, term.frequency);
    }
    const std::uint32_t columns =
        std::clamp(kColumnsPerWave * highest, 1U, brdf::TableShape::kMostColumns);
    const auto wave = [&](std::uint32_t k, std::uint32_t column) {
        const double angle = terms[k].frequency * (2 * kPi) * column / columns;
        return terms[k].is_sine ? std::sin(angle) : std::cos(angle);
    };
    return tabulated(
        std::move(name), static_cast<std::uint32_t>(terms.size()), lobe_weights, grid, columns,
        [&](std::uint32_t k, std::uint32_t row, std::uint32_t column) {
            return terms[k].g[row] * wave(k, column);
        },
        [&](std::uint32_t k, std::uint32_t l, std::uint32_t row, std::uint32_t column) {
            return terms[k].h(row, l) * wave(k, column);
        });
}

brdf::FactoredBrdf brdf_from_factors(std::string name,
                                     const NonnegativeFactors& factors,
                                     std::span<const double> lobe_weights,
                                     const PolarGrid& grid) {
    const auto columns = static_cast<std::uint32_t>(factors.g.rows()) / grid.rows();
    return tabulated(
        std::move(name), static_cast<std::uint32_t>(factors.g.cols()), lobe_weights, grid,
        columns,
        [&](std::uint32_t k, std::uint32_t row, std::uint32_t column) {
            return factors.g(column * grid.rows() + row, k);
        },
        [&](std::uint32_t k, std::uint32_t l, std::uint32_t row, std::uint32_t column) {
            return factors.h[l](column * grid.rows() + row, k);
        });
}

}  // namespace relume::factors
