// PBI after the light rests.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

constexpr const char* kPbi = "pbi-30-area";

// PBI-30 against another method, some images after the light rests.
Claim resting_claim(const std::vector<LightRun>& runs,
                    const std::string& other,
                    std::uint32_t images,
                    const std::string& source,
                    Measure measure,
                    Measure beside,
                    const std::string& why) {
    const auto ratio = [&](Measure of) {
        return [&, of](const LightRun& run) {
            return at_rest(run, kPbi, images, of) / at_rest(run, other, images, of);
        };
    };
    const auto pbi = [&](const LightRun& run) { return at_rest(run, kPbi, images, measure); };
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return ratio(measure)(run) <= 1; });
    return {.claim = fmt::format("{} images after the light rests PBI-30 is no worse than {}: "
                                 "ratio ≤ 1",
                                 images, other),
            .source = source,
            .measure = std::string(measure.name),
            .found = fmt::format("{}; PBI-30 itself: {}", by_light(runs, ratio(measure)),
                                 by_light(runs, pbi)),
            .beside = fmt::format("{}: {}", beside.name, by_light(runs, ratio(beside))),
            .holds = holds,
            .why = holds ? "" : why};
}

}  // namespace

std::vector<Claim> rest_claims(Evidence& evidence) {
    const std::vector<LightRun>& runs = evidence.rotations();
    const std::string figure = "[Overbeck06T §6.3, fig. 6.2]";
    const std::string few_lamps =
        "By then PBI has spent 180 terms on the light that stays, which few lamps make: NWA "
        "needs no more for them.";
    const std::string nothing_anew =
        "Where the sun makes the light BI keeps up with it, so that PBI has begun bands anew "
        "for "
        "nothing; both then converge alike.";
    return {
        resting_claim(runs, "nwa-300-area", kSoon, "[Overbeck06T §7.1, fig. 7.1], by eye",
                      kImageL2, kLightingL1, few_lamps),
        resting_claim(runs, "nwa-500-area", kLater, figure, kLightingL1, kImageL2, few_lamps),
        resting_claim(runs, "bi-30-area", kSoon, figure, kLightingL1, kImageL2, nothing_anew),
        resting_claim(runs, "bi-30-area", kLater, figure, kLightingL1, kImageL2, nothing_anew),
    };
}

}  // namespace relume::lab
