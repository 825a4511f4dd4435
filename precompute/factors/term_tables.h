// Terms on a grid as the tables of a factored BRDF, each term scaled as factored_brdf.h says.
#pragma once

#include "precompute/factors/azimuthal_svd.h"
#include "precompute/factors/nonnegative_factors.h"
#include "protocol/brdf/factored_brdf.h"

#include <span>
#include <string>

namespace relume::factors {

[[nodiscard]] brdf::FactoredBrdf brdf_from_terms(std::string name,
                                                 std::span<const AzimuthalTerm> terms,
                                                 std::span<const double> lobe_weights,
                                                 const PolarGrid& grid);

[[nodiscard]] brdf::FactoredBrdf brdf_from_factors(std::string name,
                                                   const NonnegativeFactors& factors,
                                                   std::span<const double> lobe_weights,
                                                   const PolarGrid& grid);

}  // namespace relume::factors
