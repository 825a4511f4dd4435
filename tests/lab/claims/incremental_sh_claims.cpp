// PBI in spherical harmonics.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

constexpr const char* kFilled = "pbi-sh-filled-25";
constexpr Measure kFlicker{"flicker", [](const Record& record) { return record.flicker; }};

Claim ratio_claim(const std::vector<LightRun>& runs,
                  const std::string& claim,
                  const std::string& other,
                  Measure measure,
                  double most,
                  const std::string& why) {
    const auto ratio = [&](Measure of) {
        return [&, of](const LightRun& run) { return ratio_of_means(run, kFilled, other, of); };
    };
    const bool holds = under_all_lights(
        runs, [&](const LightRun& run) { return ratio(measure)(run) <= most; });
    return {
        .claim = fmt::format("{}: ratio of means ≤ {}", claim, most),
        .source = "[Overbeck06T §8, figs. 8.1, 8.2]",
        .measure = fmt::format("images by eye; here {}", measure.name),
        .found = by_light(runs, ratio(measure)),
        // Of coefficients a linear order leaves nothing off in its own basis.
        .beside = fmt::format("{}: {}", kRadianceL1.name, by_light(runs, ratio(kRadianceL1))),
        .holds = holds,
        .why = holds ? "" : why};
}

}  // namespace

std::vector<Claim> incremental_sh_claims(Evidence& evidence) {
    const LabScene scene = evidence.scene_in_both_bases("table");
    std::vector<LightRun> runs;
    for (const std::string& light : evidence.lights()) {
        runs.push_back(evidence.run(scene, light, "slow-fast-slow",
                                    {"sh-5", "sh-10", kFilled, "pbi-sh-25"}));
    }
    return {
        ratio_claim(
            runs,
            "25 coefficients an image of order 20, bands filled from the lowest, err no "
            "more than linear order 5 while the light turns",
            "sh-5", kImageL2, 1,
            "The lowest bands turn by as much as the others, so that filling them takes "
            "most of the 25."),
        ratio_claim(
            runs, "They are comparable to linear order 10 (100 coefficients)", "sh-10",
            kImageL2, 1.1,
            "In the fast images 25 differences are fewer than the bands below 10 have."),
        ratio_claim(runs, "They flicker minimally, no more than linear order 10", "sh-10",
                    kFlicker, 1.1,
                    "A linear approximation has no flicker but that of its error, which turns "
                    "with the light; here a coefficient waits and then jumps."),
        ratio_claim(runs,
                    "Filling bands from the lowest flickers less than choosing the largest "
                    "differences",
                    "pbi-sh-25-area", kFlicker, 1, "See the figures."),
    };
}

}  // namespace relume::lab
