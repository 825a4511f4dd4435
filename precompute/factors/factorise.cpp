#include "precompute/factors/factorise.h"

#include "precompute/factors/error.h"
#include "precompute/factors/negative_part.h"
#include "precompute/factors/nonnegative_factors.h"
#include "precompute/factors/term_errors.h"
#include "precompute/factors/term_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::factors {
namespace {

constexpr std::uint32_t kMostNmfRows = 129;
constexpr std::uint32_t kNmfColumns = 128;
// Where no sum meets the target, terms are taken as long as those that are left would lower the
// error by this part of it or more.
constexpr double kLeastGain = 0.1;

void require_usable(const BrdfLobes& lobes, const FactorOptions& options) {
    if (lobes.count() < 1 || lobes.count() > brdf::FactoredBrdf::kMostLobes) {
        throw FactorError(fmt::format("{} lobes, expected 1 … {}", lobes.count(),
                                      brdf::FactoredBrdf::kMostLobes));
    }
    if (!(options.target_error > 0)) {
        throw FactorError(
            fmt::format("a target error of {}, expected one above 0", options.target_error));
    }
    if (options.method == Method::nmf && options.light != LightModel::uncorrelated) {
        throw FactorError(
            "non-negative factors for natural light: they are fitted to uncorrelated light");
    }
    if (options.terms &&
        (*options.terms < 1 || *options.terms > brdf::FactoredBrdf::kMostTerms)) {
        throw FactorError(fmt::format("{} terms, expected 1 … {}", *options.terms,
                                      brdf::FactoredBrdf::kMostTerms));
    }
}

// How many terms errors are told for.
std::size_t told_terms(const FactorOptions& options) {
    return std::max(options.terms.value_or(0), FactorOptions::kMostChosenTerms);
}

// A sum of terms for every K, before one of them becomes tables.
struct Candidates {
    std::vector<double> errors;    // [K − 1]
    std::vector<bool> tears_pair;  // [K − 1]
    double square = 0;             // ∬ ρ² dμ dμ, summed over colours
};

// The K to take, at most as many as there are candidates.
std::size_t chosen_terms(const Candidates& candidates, const FactorOptions& options) {
    const std::size_t available = candidates.errors.size();
    if (options.terms) {
        return std::min<std::size_t>(*options.terms, available);
    }
    const auto most = std::min<std::size_t>(available, FactorOptions::kMostChosenTerms);
    const auto smallest_below = [&](double error) -> std::size_t {
        for (std::size_t k = 1; k <= most; ++k) {
            if (!candidates.tears_pair[k - 1] && candidates.errors[k - 1] <= error) {
                return k;
            }
        }
        return 0;
    };
    if (const std::size_t terms = smallest_below(options.target_error); terms > 0) {
        return terms;
    }
    std::size_t last = most;
    while (last > 1 && candidates.tears_pair[last - 1]) {
        --last;
    }
    // A first term that tears a pair is taken where nothing else can be.
    return std::max<std::size_t>(smallest_below(candidates.errors[last - 1] / (1 - kLeastGain)),
                                 1);
}

double relative_root(double square, double whole) {
    return whole > 0 ? std::sqrt(std::max(0.0, square) / whole) : 0.0;
}

Candidates candidates_from(const std::vector<AzimuthalTerm>& terms,
                           const AzimuthalSpectrum& spectrum,
                           const LightWaves& light,
                           const std::vector<Imath::V3f>& colours) {
    Candidates candidates;
    candidates.square = square_in_colour(colours, spectrum.products());
    TermErrors left(spectrum, light);
    const double whole = square_in_colour(colours, left.products());
    for (const AzimuthalTerm& term : terms) {
        left.subtract(term);
        candidates.errors.push_back(
            relative_root(square_in_colour(colours, left.products()), whole));
        candidates.tears_pair.push_back(term.frequency > 0 && !term.is_sine);
    }
    return candidates;
}

Candidates candidates_from(const std::vector<NonnegativeFactors>& all,
                           const AzimuthalSpectrum& spectrum,
                           const std::vector<Imath::V3f>& colours) {
    Candidates candidates;
    candidates.square = square_in_colour(colours, spectrum.products());
    for (const NonnegativeFactors& factors : all) {
        candidates.errors.push_back(relative_root(
            square_in_colour(colours, factors.error_products), candidates.square));
        candidates.tears_pair.push_back(false);
    }
    return candidates;
}

Factorisation chosen(const Candidates& candidates,
                     std::size_t terms,
                     const FactorOptions& options,
                     const std::vector<Imath::V3f>& colours,
                     brdf::FactoredBrdf brdf) {
    Factorisation result;
    result.brdf = std::move(brdf);
    const NegativePart negative = negative_part(result.brdf, colours);
    // The measure of both hemispheres is π², and there are three colours.
    const double mean_square = candidates.square / (3 * std::numbers::pi * std::numbers::pi);
    result.largest_negative = relative_root(negative.largest * negative.largest, mean_square);
    result.negative_norm = relative_root(negative.mean_square, mean_square);
    result.errors = candidates.errors;
    result.errors.resize(told_terms(options), candidates.errors.back());
    result.error = candidates.errors[terms - 1];
    result.meets_target = result.error <= options.target_error;
    result.tears_pair = candidates.tears_pair[terms - 1];
    return result;
}

Factorisation by_svd(std::string name, const BrdfLobes& lobes, const FactorOptions& options) {
    const AzimuthalSpectrum spectrum(lobes, rows_for_width(lobes.width_rad),
                                     LightWaves::frequencies(options.light));
    const LightWaves light(options.light, spectrum.grid());
    const std::vector<double> weights = lobes.weights();
    const std::vector<AzimuthalTerm> terms =
        azimuthal_svd(spectrum, light, weights, told_terms(options));
    const Candidates candidates = candidates_from(terms, spectrum, light, lobes.mean_colours);
    const std::size_t count = chosen_terms(candidates, options);
    return chosen(candidates, count, options, lobes.mean_colours,
                  brdf_from_terms(std::move(name), std::span(terms).first(count), weights,
                                  spectrum.grid()));
}

Factorisation by_nmf(std::string name, const BrdfLobes& lobes, const FactorOptions& options) {
    const std::uint32_t rows = std::min(rows_for_width(lobes.width_rad), kMostNmfRows);
    const double step = std::numbers::pi / 2 / (rows - 1);
    if (step > lobes.width_rad) {
        throw FactorError(fmt::format(
            "a highlight {:.3g} rad wide, expected at least {:.3g} rad for non-negative "
            "factors; a singular value decomposition takes it",
            lobes.width_rad, step));
    }
    const AzimuthalSpectrum spectrum(lobes, rows, frequencies_for_columns(kNmfColumns));
    const std::vector<double> weights = lobes.weights();
    const std::vector<NonnegativeFactors> all =
        nonnegative_factors(spectrum, weights, kNmfColumns, told_terms(options));
    const Candidates candidates = candidates_from(all, spectrum, lobes.mean_colours);
    const std::size_t count = chosen_terms(candidates, options);
    return chosen(candidates, count, options, lobes.mean_colours,
                  brdf_from_factors(std::move(name), all[count - 1], weights, spectrum.grid()));
}

}  // namespace

Factorisation factorise(std::string name,
                        const BrdfLobes& lobes,
                        const FactorOptions& options) {
    require_usable(lobes, options);
    return options.method == Method::svd ? by_svd(std::move(name), lobes, options)
                                         : by_nmf(std::move(name), lobes, options);
}

Factorisation factorise(std::string name,
                        const scene::Bsdf& mean,
                        const FactorOptions& options) {
    if (!mean.is_diffuse()) {
        return factorise(std::move(name), lobes_of(mean), options);
    }
    require_usable(lobes_of(mean), options);
    Factorisation result;
    result.brdf = brdf::factored_lambert(std::move(name), mean.diffuse_colour());
    result.errors.assign(told_terms(options), 0.0);
    result.meets_target = true;
    return result;
}

}  // namespace relume::factors
