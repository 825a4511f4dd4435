// By what the terms of a light are best ranked.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

// The same under every light: NWA-100 ranked by area over ranked otherwise.
Claim area_claim(Evidence& evidence, const std::string& material, const std::string& builtin) {
    const LabScene scene = evidence.scene(builtin);
    std::vector<LightRun> runs;
    for (const std::string& light : evidence.lights()) {
        runs.push_back(evidence.run(scene, light, "quick-turn",
                                    {"nwa-100-area", "nwa-100-none", "nwa-100-transport"}));
    }
    const auto over = [](const std::string& other) {
        return [other](const LightRun& run) {
            return run.of("nwa-100-area").l2 / run.of(other).l2;
        };
    };
    const auto over_none = over("nwa-100-none");
    const auto over_transport = over("nwa-100-transport");
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        return over_none(run) <= 1 && over_transport(run) <= 1;
    });
    return {.claim = fmt::format("On a {} scene area-weighted choice errs least of the three: "
                                 "ratios ≤ 1",
                                 material),
            .source = "[Ng03 §4.1]",
            .found =
                fmt::format("{}, NWA-100 by area, L2 of the image, over unweighted: {}; "
                            "over transport-weighted: {}",
                            builtin, by_light(runs, over_none), by_light(runs, over_transport)),
            .holds = holds,
            .why = holds
                       ? ""
                       : "Our transport weight is the norm of the whole column over the image "
                         "that is measured, which knows what the camera sees; area only knows "
                         "the light."};
}

}  // namespace

std::vector<Claim> priority_claims(Evidence& evidence) {
    return {area_claim(evidence, "diffuse", "box"), area_claim(evidence, "glossy", "thin")};
}

}  // namespace relume::lab
