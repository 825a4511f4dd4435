// One environment turned into another, as when one walks from room to room.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

#include <utility>

namespace relume::lab {

std::vector<Claim> blend_claims(Evidence& evidence) {
    constexpr const char* kPbi = "pbi-30-area";
    const std::pair<const char*, const char*> pairs[] = {
        {"studio", "night"}, {"night", "courtyard"}, {"courtyard", "studio"}};
    std::vector<LightRun> runs;
    for (const auto& [light, other] : pairs) {
        runs.push_back(evidence.run(evidence.demo(), light, "blend",
                                    {"nwa-30", "nwa-100", "pbi-30"}, other));
        runs.back().light = fmt::format("{} to {}", light, other);
    }
    const auto ratio = [](const char* other, Measure measure) {
        return [other, measure](const LightRun& run) {
            return ratio_of_means(run, kPbi, other, measure);
        };
    };
    std::vector<Claim> claims;
    for (const char* other : {"nwa-30-area", "nwa-100-area"}) {
        const bool holds = under_all_lights(
            runs, [&](const LightRun& run) { return ratio(other, kImageL2)(run) <= 1; });
        claims.push_back(
            {.claim =
                 fmt::format("While one light becomes another PBI-30 errs no more than {}: "
                             "ratio of means ≤ 1",
                             other),
             .source = "[Overbeck06T §7.2, fig. 7.2]",
             .measure = "images by eye; here L2 of the image",
             .found = by_light(runs, ratio(other, kImageL2)),
             .beside = fmt::format("{}: {}; {}: {}", kLightingL1.name,
                                   by_light(runs, ratio(other, kLightingL1)), kRadianceL1.name,
                                   by_light(runs, ratio(other, kRadianceL1))),
             .holds = holds,
             .why = holds ? ""
                          : "Every coefficient of both lights changes in every image, and what "
                            "was brought in is soon old."});
    }
    return claims;
}

}  // namespace relume::lab
