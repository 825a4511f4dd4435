// Choosing the bands to reset with more care, and in another norm.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

constexpr const char* kSimple = "pbi-30-area";

Claim ratio_claim(const std::vector<LightRun>& runs,
                  const std::string& claim,
                  const std::string& source,
                  const std::string& method,
                  double least,
                  double most,
                  const std::string& why) {
    const auto ratio = [&](Measure measure) {
        return [&, measure](const LightRun& run) {
            return ratio_of_means(run, method, kSimple, measure);
        };
    };
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        const double found = ratio(kLightingL1)(run);
        return found >= least && found <= most;
    });
    return {.claim = fmt::format("{}: ratio of means in [{}, {}]", claim, least, most),
            .source = source,
            .measure = std::string(kLightingL1.name),
            .found = "over simple's: " + by_light(runs, ratio(kLightingL1)),
            .beside = fmt::format("{}: {}; {}: {}", kRadianceL1.name,
                                  by_light(runs, ratio(kRadianceL1)), kImageL2.name,
                                  by_light(runs, ratio(kImageL2))),
            .holds = holds,
            .why = holds ? "" : why};
}

}  // namespace

std::vector<Claim> selector_claims(Evidence& evidence) {
    const std::vector<LightRun>& runs = evidence.rotations();
    const std::string figure = "[Overbeck06T §6.3, inset of fig. 6.2]";
    const std::string footnote = "[Overbeck06T §6.2.2, footnote]";
    const std::string short_sighted =
        "It minimises the error of this image in the coefficients, which is neither what is "
        "left "
        "over the images to come nor that of the light on the sphere.";
    return {
        ratio_claim(runs, "The dealer selector is only marginally better than the simple one",
                    figure, "pbi-dealer-30-area", 0.9, 1, short_sighted),
        ratio_claim(runs,
                    "The exhaustive selector is only marginally better than the simple one",
                    figure, "pbi-exhaustive-30-area", 0.9, 1, short_sighted),
        ratio_claim(runs, "The simple selector gives similar results with L2", footnote,
                    "pbi-l2-30-area", 0.9, 1.1,
                    "L2 sees the brightest coefficients alone, which lamps leave behind."),
        ratio_claim(runs, "The dealer selector gives similar results with L2", footnote,
                    "pbi-dealer-l2-30-area", 0.9, 1.1,
                    "L2 deals terms to the band of the brightest lamps."),
        ratio_claim(runs, "The exhaustive selector gives similar results with L2", footnote,
                    "pbi-exhaustive-l2-30-area", 0.9, 1.1,
                    "L2 keeps the bands of the brightest lamps in order, others not."),
    };
}

}  // namespace relume::lab
