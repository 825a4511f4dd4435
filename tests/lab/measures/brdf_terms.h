// How many terms a BRDF needs as a sum of products: errors for K = 1 … 10.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/factorise.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

struct LabBrdf {
    std::string name;
    factors::BrdfLobes lobes;
};

// Highlights alone, white: Phong of exponent 10, 50 and 200, metals of roughness 0.1, 0.3 and
// 0.6. Then a coloured plastic of roughness 0.4, tabulated as MERL's database is.
[[nodiscard]] std::vector<LabBrdf> lab_brdfs();
// A file of that database, named after the file. Throws FactorError.
[[nodiscard]] LabBrdf measured_brdf(const std::filesystem::path& file);

struct BrdfTerms {
    std::string brdf;
    std::string method;                // "svd", "nmf"
    std::string light;                 // "uncorrelated", "natural"
    std::vector<double> errors;        // [K − 1], relative L2
    double largest_negative_of_5 = 0;  // with five terms, over the root mean square of ρ
    double negative_norm_of_5 = 0;     // relative L2
    std::uint32_t rows = 0;            // of the tables
    std::uint32_t columns = 0;
};

// By SVD in uncorrelated and in natural light, and by NMF.
[[nodiscard]] std::vector<BrdfTerms> measure_brdf_terms(const LabBrdf& brdf);

// The smallest K whose error is at most so much; 0 where none is.
[[nodiscard]] std::size_t terms_for(const BrdfTerms& measured, double error);

}  // namespace relume::lab
