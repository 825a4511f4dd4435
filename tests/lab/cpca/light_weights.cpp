#include "tests/lab/cpca/light_weights.h"

#include "precompute/bake/blocks/light_model.h"

#include <algorithm>
#include <cstddef>

namespace relume::lab {
namespace {

constexpr std::size_t kColumnsPerBand = 256;

}  // namespace

LightWeights::LightWeights(const basis::CubemapBasis& basis)
    : variances(bake::natural_deviations(basis)), constant(basis.constant_light()) {
    for (float& variance : variances) {
        variance *= variance;
    }
    std::vector<std::vector<std::uint32_t>> of_band(basis.band_count());
    for (std::uint32_t j = 0; j < basis.coefficient_count(); ++j) {
        all.push_back({.index = j});
        of_band[basis.band_from_coefficient(j)].push_back(j);
    }
    for (const std::vector<std::uint32_t>& columns : of_band) {
        const std::size_t kept = std::min(columns.size(), kColumnsPerBand);
        for (std::size_t i = 0; i < kept; ++i) {
            some.push_back(
                {.index = columns[i * columns.size() / kept],
                 .weight = static_cast<float>(columns.size()) / static_cast<float>(kept)});
        }
    }
}

}  // namespace relume::lab
