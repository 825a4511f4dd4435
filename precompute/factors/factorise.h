// From lobes to a factored BRDF of as many terms as an error asks for.
//
// Errors are relative L2 errors of what is reflected, red, green and blue with the lobes' mean
// colours, over all ωo weighted by cos θo and over random lights (light_waves.h). In
// uncorrelated light that is the error of ρ itself, under cos θi dωi × cos θo dωo; in natural
// light it is the error that an image is likely to have.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "precompute/factors/light_waves.h"
#include "protocol/base/text/name_table.h"
#include "protocol/brdf/factored_brdf.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::factors {

enum class Method : std::uint8_t {
    svd,  // the least error; factors and the sum may be negative
    nmf,  // nothing is negative
};

// As options and reports spell them.
inline constexpr text::NameTable<Method, 2> kMethodNames({{
    {Method::svd, "svd"},
    {Method::nmf, "nmf"},
}});

struct FactorOptions {
    // What a report tells and a target may ask for. A fixed number of terms may be higher.
    static constexpr std::uint32_t kMostChosenTerms = 10;

    Method method = Method::svd;
    // What the sum is the best for, and errors count in; NMF takes uncorrelated light alone.
    LightModel light = LightModel::uncorrelated;
    double target_error = 0.05;            // above 0
    std::optional<std::uint32_t> terms{};  // 1 … 16, instead of a target
};

struct Factorisation {
    brdf::FactoredBrdf brdf;
    // errors[k − 1]: with k terms, k = 1 … 10 or as many as were asked for, if more. Where the
    // lobes have no more terms the last error stands for all after it.
    std::vector<double> errors;
    double error = 0;           // with the terms that brdf has
    bool meets_target = false;  // target_error, also where the number of terms was given
    // One of a pair is left out: what is reflected depends on the tangent, and turning light,
    // surface and viewer about the normal changes it. A target never tears a pair.
    bool tears_pair = false;
    // The most negative value that the tables give, in units of the root mean square of ρ's
    // three colours, and the relative L2 norm of all that is negative; 0 where nothing is.
    double largest_negative = 0;
    double negative_norm = 0;
};

// Chooses the fewest terms that meet the target, at most 10 and no torn pair; where none do,
// the fewest from which all further ones up to 10 would take less than a tenth of the error. A
// constant BRDF gets its one term exactly. Throws FactorError for options out of range, and for
// NMF of a highlight that 129 rows cannot tell. Deterministic; at most 450 MiB, on all cores.
[[nodiscard]] Factorisation factorise(std::string name,
                                      const BrdfLobes& lobes,
                                      const FactorOptions& options = {});
[[nodiscard]] Factorisation factorise(std::string name,
                                      const scene::Bsdf& mean,
                                      const FactorOptions& options = {});

}  // namespace relume::factors
