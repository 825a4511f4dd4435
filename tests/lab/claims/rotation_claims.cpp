// PBI against BI and NWA while the light turns.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"

#include <fmt/format.h>

#include <functional>

namespace relume::lab {
namespace {

constexpr const char* kPbi = "pbi-30-area";
constexpr const char* kBi = "bi-30-area";
constexpr const char* kFigure = "[Overbeck06T §6.3, fig. 6.2]";

// A figure of every light, in the measures beside the source's.
std::string beside(const std::vector<LightRun>& runs,
                   const std::function<std::function<double(const LightRun&)>(Measure)>& of) {
    return fmt::format("{}: {}; {}: {}", kRadianceL1.name, by_light(runs, of(kRadianceL1)),
                       kImageL2.name, by_light(runs, of(kImageL2)));
}

// Part of the images in which one method errs no more than the other.
Claim share_claim(const std::vector<LightRun>& runs,
                  const std::string& claim,
                  const std::string& method,
                  const std::string& other,
                  Part part,
                  double least,
                  const std::string& why) {
    const auto share_in = [&](Measure measure, Part of_part) {
        return [&, measure, of_part](const LightRun& run) {
            return share_no_worse(run, method, other, measure, of_part);
        };
    };
    const auto share = [&](Measure measure) { return share_in(measure, part); };
    const bool holds = under_all_lights(
        runs, [&](const LightRun& run) { return share(kLightingL1)(run) >= least; });
    return {
        .claim = fmt::format("{}: in at least {:.0f} % of the images", claim, 100 * least),
        .source = kFigure,
        .measure = std::string(kLightingL1.name),
        .found = fmt::format("part of the images: {}; of the slower half while it turns: {}",
                             by_light(runs, share(kLightingL1)),
                             by_light(runs, share_in(kLightingL1, Part::slow))),
        .beside = beside(runs, share),
        .holds = holds,
        .why = holds ? "" : why};
}

Claim bi_and_pbi_claim(const std::vector<LightRun>& runs) {
    const auto ratio = [](Measure measure) {
        return
            [measure](const LightRun& run) { return ratio_of_means(run, kPbi, kBi, measure); };
    };
    const bool holds = under_all_lights(
        runs, [&](const LightRun& run) { return ratio(kLightingL1)(run) < 1; });
    return {.claim = "PBI-30 errs less than BI-30 while the light turns: ratio of means < 1",
            .source = kFigure,
            .measure = std::string(kLightingL1.name),
            .found = by_light(runs, ratio(kLightingL1)),
            .beside = beside(runs, ratio),
            .holds = holds,
            .why = holds ? "" : "Where nothing drifts away, PBI has nothing to begin anew."};
}

Claim comparable_claim(const std::vector<LightRun>& runs) {
    constexpr const char* kNwa = "nwa-100-area";
    constexpr double kNever = 0.05;
    const auto share = [](Measure measure) {
        return [measure](const LightRun& run) {
            return share_no_worse(run, kPbi, kNwa, measure, Part::moving);
        };
    };
    const auto ratio = [](const LightRun& run) {
        return ratio_of_means(run, kPbi, kNwa, kLightingL1);
    };
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        const double part = share(kLightingL1)(run);
        return part > kNever && part < 1 - kNever;
    });
    return {
        .claim =
            "While the light turns PBI-30 is now better, now worse than NWA-100: better in "
            "5 % to 95 % of the images",
        .source = kFigure,
        .measure = std::string(kLightingL1.name),
        .found = fmt::format("part of the images: {}; ratio of means: {}",
                             by_light(runs, share(kLightingL1)), by_light(runs, ratio)),
        .beside = beside(runs, share),
        .holds = holds,
        .why = holds ? ""
                     : "How many terms a light needs is the light's own: where few lamps make "
                       "it, NWA-100 holds nearly all of it."};
}

// What NWA needs for the error that PBI leaves with `terms`, over `terms`; as text, for there
// may be no number.
Claim equal_quality_claim(const std::vector<LightRun>& runs, std::uint32_t terms) {
    constexpr double kLeast = 3;
    const std::string pbi = fmt::format("pbi-{}-area", terms);
    const auto nwa_terms = [&](const LightRun& run, Measure measure) {
        return nwa_terms_at(run, mean_of(run, pbi, measure), measure);
    };
    const auto text = [&](Measure measure) {
        std::string all;
        for (const LightRun& run : runs) {
            const auto needed = nwa_terms(run, measure);
            all += fmt::format("{}{} {}", all.empty() ? "" : ", ", run.light,
                               needed ? fmt::format("{:.1f}", *needed / terms)
                                      : fmt::format("> {:.0f}", 1000.0 / terms));
        }
        return all;
    };
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        const auto needed = nwa_terms(run, kImageL2);
        return !needed || *needed >= kLeast * terms;
    });
    return {.claim = fmt::format("While the light turns NWA needs three to four times as many "
                                 "terms as PBI-{}: at least 3",
                                 terms),
            .source = "[Overbeck06T §7.1, fig. 7.1]",
            .measure = "images by eye; here L2 of the image",
            .found = text(kImageL2),
            .beside = fmt::format("{}: {}; {}: {}", kLightingL1.name, text(kLightingL1),
                                  kRadianceL1.name, text(kRadianceL1)),
            .holds = holds,
            .why = holds ? ""
                         : "The mean is that of the faster images, where up to 7 degrees an "
                           "image are more than two texels and little of the last image is "
                           "right in this one."};
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
    return {.claim = "PBI never resets the two coarsest bands: no image does",
            .source = "[Overbeck06T §6.3, fig. 6.4]",
            .measure = "resets",
            .found = fmt::format("images of PBI-30 that reset one of them, of {} in all: {}",
                                 images, by_light(runs, resets)),
            .beside = "",
            .holds = holds,
            .why = holds ? ""
                         : "It happens in the fastest images. The paper's maps have 64 texels "
                           "along a face and six bands, ours 32 and five: a turn by 7 degrees "
                           "is the same part of the coarsest wavelets, but few lamps make all "
                           "of our light."};
}

}  // namespace

std::vector<Claim> rotation_claims(Evidence& evidence) {
    constexpr double kEssentiallyAlways = 0.95;
    const std::vector<LightRun>& runs = evidence.rotations();
    return {
        share_claim(
            runs, "PBI-30 is essentially always better than NWA-60", kPbi, "nwa-60-area",
            Part::whole, kEssentiallyAlways,
            "In the fastest images, at up to 7 degrees or two texels an image, little of "
            "the last image is right in this one, and thirty terms do what NWA does "
            "with sixty. The measure is not the reason: three agree."),
        comparable_claim(runs),
        share_claim(
            runs, "BI-30 is always better than NWA-30", kBi, "nwa-30-area", Part::whole, 1,
            "Where the light turns by more than a texel an image, ghosts of bright lamps "
            "weigh more than what NWA leaves out."),
        bi_and_pbi_claim(runs),
        equal_quality_claim(runs, 30),
        equal_quality_claim(runs, 100),
        coarse_bands_claim(runs),
    };
}

}  // namespace relume::lab
