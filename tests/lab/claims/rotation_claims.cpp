// PBI against NWA while the light turns and after it rests.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

constexpr const char* kSource = "[Overbeck06 §6]";
constexpr const char* kPbi = "pbi-30-area";

double mean_l2(const LightRun& run, const std::string& method, bool fast) {
    // slow-fast-slow covers four fifths of its way in images 25 to 74.
    double sum = 0;
    double count = 0;
    for (const Record& record : records_of(run.findings.records, method)) {
        const bool is_fast = record.image >= 25 && record.image < 75;
        if (record.image < 100 && is_fast == fast) {
            sum += record.error.l2;
            count += 1;
        }
    }
    return sum / count;
}

// PBI-30 against NWA with more terms, over the images that move.
Claim moving_claim(const std::vector<LightRun>& runs, const std::string& nwa) {
    const auto ratio = [&](const LightRun& run) { return run.of(kPbi).l2 / run.of(nwa).l2; };
    const auto half = [&](bool fast) {
        return by_light(runs, [&, fast](const LightRun& run) {
            return mean_l2(run, kPbi, fast) / mean_l2(run, nwa, fast);
        });
    };
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return ratio(run) <= 1; });
    return {
        .claim = fmt::format("While the light turns PBI-30 errs no more than {}: ratio of "
                             "means ≤ 1",
                             nwa),
        .source = kSource,
        .found = fmt::format("L2 of the image: {}; in the slower half of the images: {}; in "
                             "the faster: {}",
                             by_light(runs, ratio), half(false), half(true)),
        .holds = holds,
        .why = holds ? ""
                     : "Up to 7 degrees an image are more than two texels: in the faster "
                       "half little of the last image is right in this one, and thirty "
                       "terms are left to do what NWA does with more. Our scene is glossy "
                       "and shows it."};
}

// PBI-30 against NWA with more terms, some images after the light rests.
Claim resting_claim(const std::vector<LightRun>& runs,
                    const std::string& nwa,
                    std::uint32_t images,
                    double Summary::*error) {
    const auto pbi = [&](const LightRun& run) { return run.of(kPbi).*error; };
    const auto ratio = [&](const LightRun& run) { return pbi(run) / (run.of(nwa).*error); };
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return ratio(run) <= 1; });
    return {.claim = fmt::format("{} images after the light rests PBI-30 is no worse than {}: "
                                 "ratio ≤ 1",
                                 images, nwa),
            .source = kSource,
            .found = fmt::format("L2 of the image: {}; PBI-30 itself: {}",
                                 by_light(runs, ratio), by_light(runs, pbi)),
            .holds = holds,
            .why = holds
                       ? ""
                       : fmt::format("By then PBI has spent {} terms on the light that stays; "
                                     "where NWA needs few terms, as under few lamps, it takes "
                                     "some images more.",
                                     30 * (images + 1))};
}

Claim coarse_bands_claim(const std::vector<LightRun>& runs) {
    constexpr std::uint32_t kTwoCoarsest = 0b11;
    std::size_t images = 0;
    const auto resets = [](const LightRun& run) {
        double count = 0;
        for (const Record& record : records_of(run.findings.records, kPbi)) {
            count += (record.bands_reset & kTwoCoarsest) != 0 ? 1 : 0;
        }
        return count;
    };
    for (const LightRun& run : runs) {
        images += run.findings.images_done;
    }
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return resets(run) == 0; });
    return {
        .claim = "PBI never resets the two coarsest bands: no image does",
        .source = "[Overbeck06 §5]",
        .found = fmt::format("images of PBI-30 that reset one of them, of {} in all: {}",
                             images, by_light(runs, resets)),
        .holds = holds,
        .why = holds
                   ? ""
                   : "It happens in the fastest images, together with finer bands: lamps that "
                     "turn by more than two texels leave their place in band 1 as well "
                     "(16 by 16 texels a wavelet), and the criterion takes the sums of "
                     "absolute values band by band, whatever the band's number."};
}

}  // namespace

std::vector<Claim> rotation_claims(Evidence& evidence) {
    const std::vector<LightRun>& runs = evidence.rotations();
    return {
        moving_claim(runs, "nwa-60-area"),
        moving_claim(runs, "nwa-100-area"),
        resting_claim(runs, "nwa-300-area", kSoon, &Summary::soon_l2),
        resting_claim(runs, "nwa-500-area", kLater, &Summary::later_l2),
        coarse_bands_claim(runs),
    };
}

}  // namespace relume::lab
