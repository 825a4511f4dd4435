// By what the terms of a light are best ranked.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::lab {
namespace {

constexpr std::uint32_t kFewerThan = 1000;

// Of the numbers of terms below a thousand, how many are best ranked by area.
struct Count {
    std::string light;
    std::uint32_t best = 0;
    std::uint32_t all = 0;
    double worst_ratio = 0;  // by area over the best of the three, at most
};

Count count_of(Evidence& evidence, const LabScene& scene, const std::string& light) {
    const std::vector<TermsCurve> curves =
        evidence.terms(scene, light, {"nwa-{}-area", "nwa-{}-none", "nwa-{}-transport"});
    Count count{.light = light};
    for (std::size_t i = 0; i < curves[0].records.size(); ++i) {
        if (curves[0].records[i].applied >= kFewerThan) {
            break;
        }
        const double area = curves[0].records[i].error.l2;
        const double best = std::min(
            {area, curves[1].records.at(i).error.l2, curves[2].records.at(i).error.l2});
        count.best += area <= best ? 1 : 0;
        count.all += 1;
        count.worst_ratio = std::max(count.worst_ratio, area / best);
    }
    return count;
}

// The same under every light.
Claim area_claim(Evidence& evidence, const std::string& material, const std::string& builtin) {
    const LabScene scene = evidence.scene(builtin);
    std::string found;
    bool holds = true;
    for (const std::string& light : evidence.lights()) {
        const Count count = count_of(evidence, scene, light);
        found += fmt::format("{}{} {} of {}, at most {:.2g} times the best's",
                             found.empty() ? "" : "; ", light, count.best, count.all,
                             count.worst_ratio);
        holds = holds && count.best == count.all;
    }
    return {
        .claim = fmt::format("On a {} scene, with fewer than 1,000 terms, area-weighted choice "
                             "errs least of the three: at all numbers of terms",
                             material),
        .source = "[Ng03 §4.1.2]",
        .measure = "L2 of the image",
        .found = fmt::format("{}, the first light, numbers of terms at which area is best: {}",
                             builtin, found),
        .beside = "",
        .holds = holds,
        .why = holds ? ""
                     : "Our transport weight is the norm of the whole column over the image "
                       "that is measured, which knows what the camera sees; area only knows "
                       "the light."};
}

}  // namespace

std::vector<Claim> priority_claims(Evidence& evidence) {
    return {area_claim(evidence, "diffuse", "box"), area_claim(evidence, "glossy", "thin")};
}

}  // namespace relume::lab
