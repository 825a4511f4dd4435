// PBI against NWA while the light turns and after it rests.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

// PBI-30's image error over that of NWA with more terms, by light.
Claim ratio_claim(const std::vector<LightRun>& runs,
                  std::string claim,
                  std::string source,
                  const std::string& nwa,
                  double Summary::*error,
                  std::string why) {
    const auto ratio = [&](const LightRun& run) {
        return run.of("pbi-30-area").*error / run.of(nwa).*error;
    };
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return ratio(run) <= 1; });
    return {
        .claim = std::move(claim),
        .source = std::move(source),
        .found = fmt::format("PBI-30 over {}, L2 of the image: {}", nwa, by_light(runs, ratio)),
        .holds = holds,
        .why = holds ? "" : std::move(why)};
}

Claim coarse_bands_claim(const std::vector<LightRun>& runs) {
    constexpr std::uint32_t kTwoCoarsest = 0b11;
    std::size_t images = 0;
    const auto resets = [](const LightRun& run) {
        double count = 0;
        for (const Record& record : records_of(run.findings.records, "pbi-30-area")) {
            count += (record.bands_reset & kTwoCoarsest) != 0 ? 1 : 0;
        }
        return count;
    };
    for (const LightRun& run : runs) {
        images += run.findings.images_done;
    }
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return resets(run) == 0; });
    return {.claim = "PBI never resets the two coarsest bands: no image does",
            .source = "[Overbeck06 §5]",
            .found = fmt::format("images of PBI-30 that reset one of them, of {} in all: {}",
                                 images, by_light(runs, resets)),
            .holds = holds,
            .why = holds
                       ? ""
                       : "A bright lamp that turns by more than the width of a coarse wavelet "
                         "from one image to the next changes the coarse bands as wholly as "
                         "the fine ones; where the two coarsest bands are nearer from "
                         "nothing, the criterion says so."};
}

}  // namespace

std::vector<Claim> rotation_claims(Evidence& evidence) {
    const std::vector<LightRun>& runs = evidence.rotations();
    const std::string moving =
        "In the fast part thirty terms cannot follow lights that cross several texels an "
        "image, "
        "and what an increment leaves of their old place is error too; NWA has no past.";
    const std::string resting =
        "The table's glossy crockery shows fine wavelets that thirty terms an image have not "
        "reached by then.";
    return {
        ratio_claim(runs,
                    "While the light turns PBI-30 errs no more than NWA-60: mean ratio ≤ 1",
                    "[Overbeck06 §6]", "nwa-60-area", &Summary::l2, moving),
        ratio_claim(runs,
                    "While the light turns PBI-30 errs no more than NWA-100: mean ratio ≤ 1",
                    "[Overbeck06 §6]", "nwa-100-area", &Summary::l2, moving),
        ratio_claim(runs, "Five images after the light rests PBI-30 is at NWA-300: ratio ≤ 1",
                    "[Overbeck06 §6]", "nwa-300-area", &Summary::soon_l2, resting),
        ratio_claim(
            runs, "Twenty-five images after the light rests PBI-30 is below NWA-500: ratio ≤ 1",
            "[Overbeck06 §6]", "nwa-500-area", &Summary::later_l2, resting),
        coarse_bands_claim(runs),
    };
}

}  // namespace relume::lab
