// Choosing the bands to reset with more care.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

Claim marginal_claim(const std::vector<LightRun>& runs,
                     const std::string& name,
                     const std::string& method) {
    constexpr double kMarginal = 0.1;
    const auto image = [&](const LightRun& run) {
        return run.of(method).l2 / run.of("pbi-30-area").l2;
    };
    const auto lighting = [&](const LightRun& run) {
        return run.of(method).lighting_l1 / run.of("pbi-30-area").lighting_l1;
    };
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        return image(run) <= 1 && image(run) >= 1 - kMarginal;
    });
    return {.claim = fmt::format("The {} selector is only marginally better than the simple "
                                 "one: ratio of means in [0.9, 1]",
                                 name),
            .source = "thesis 6.2",
            .found = fmt::format("L2 of the image over simple's: {}; L1 of the lighting: {}",
                                 by_light(runs, image), by_light(runs, lighting)),
            .holds = holds,
            .why = holds ? ""
                         : "It minimises what is left of the weighted lighting in this image. "
                           "That is neither the image's error, columns being neither "
                           "orthogonal nor of equal energy, nor what is left over the images "
                           "to come, so that it may also come out behind."};
}

}  // namespace

std::vector<Claim> selector_claims(Evidence& evidence) {
    const std::vector<LightRun>& runs = evidence.rotations();
    return {marginal_claim(runs, "dealer", "pbi-dealer-30-area"),
            marginal_claim(runs, "exhaustive", "pbi-exhaustive-30-area")};
}

}  // namespace relume::lab
