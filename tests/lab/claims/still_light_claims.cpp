// How many wavelets a light that stands still needs.
#include "tests/lab/claims/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace relume::lab {
namespace {

// The curve's record with the most terms of at most `terms`.
const Record& at_terms(const std::vector<Record>& records, std::uint32_t terms) {
    const auto after = std::find_if(records.begin(), records.end(), [&](const Record& record) {
        return record.applied > terms;
    });
    return after == records.begin() ? records.front() : *(after - 1);
}

struct Sweep {
    std::string light;
    std::vector<Record> wavelets;
};

std::string errors_at(const std::vector<Sweep>& sweeps,
                      const std::vector<std::uint32_t>& terms) {
    std::string text;
    for (const Sweep& sweep : sweeps) {
        for (const std::uint32_t count : terms) {
            const Record& record = at_terms(sweep.wavelets, count);
            text += fmt::format("{}{}, {} terms: {:.2g}", text.empty() ? "" : "; ", sweep.light,
                                record.applied, record.error.l2);
        }
    }
    return text;
}

std::vector<Sweep> sweeps_of(Evidence& evidence,
                             const LabScene& scene,
                             const std::vector<std::string>& lights) {
    std::vector<Sweep> sweeps;
    for (const std::string& light : lights) {
        sweeps.push_back({.light = light,
                          .wavelets = std::move(
                              evidence.terms(scene, light, {"nwa-{}-area"}).front().records)});
    }
    return sweeps;
}

Claim photographed_light_claim(Evidence& evidence, const LabScene& scene) {
    // What 200 of 24,576 leave of fig. 3's image.
    constexpr double kAccurate = 0.022;
    const auto percent = static_cast<std::uint32_t>(scene.haar->columns().count() / 100);
    const std::vector<Sweep> sweeps = sweeps_of(evidence, scene, evidence.lights());
    const bool holds = std::all_of(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) {
        return at_terms(sweep.wavelets, percent).error.l2 <= kAccurate;
    });
    return {.claim =
                "0.5 to 1 % of the wavelets show photographed light accurately: with 1 % L2 "
                "≤ 0.022, as in fig. 3",
            .source = "[Ng03 §1, figs. 3, 4]",
            .measure = "L2 of the image",
            .found = "table, by area: " + errors_at(sweeps, {percent / 2, percent, 200}),
            .beside = "",
            .holds = holds,
            .why = holds ? ""
                         : "Our maps have 6,144 wavelets, the paper's 24,576, of which 1 % are "
                           "four times as many. Lamps need terms by their number and edges, "
                           "whatever the resolution."};
}

Claim outdoor_claim(Evidence& evidence, const LabScene& scene) {
    constexpr double kSuffices = 0.05;  // what 25 leave under the Uffizi Gallery's sky
    const std::vector<Sweep> sweeps =
        sweeps_of(evidence, scene, {"sky-overcast", "forest", "city"});
    const bool holds = std::all_of(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) {
        return at_terms(sweep.wavelets, 30).error.l2 <= kSuffices;
    });
    return {
        .claim =
            "20 to 30 terms suffice for smooth outdoor light without the sun: with 30 "
            "L2 ≤ 0.05",
        .source = "[Ng03 §4.2.1]",
        .measure = "by eye; here L2 of the image",
        .found = "table, by area: " + errors_at(sweeps, {20, 30}),
        .beside = "",
        .holds = holds,
        .why = holds ? "" : "Not all of these skies are smooth: leaves and roofs cut them."};
}

// The soft sky of 4.1.2: 25 terms of either.
Claim soft_sky_claim(Evidence& evidence, const LabScene& scene) {
    std::string found;
    bool holds = true;
    for (const char* light : {"sky-overcast", "forest", "city"}) {
        const std::vector<TermsCurve> curves =
            evidence.terms(scene, light, {"sh-{}", "nwa-{}-area"});
        const double harmonics = at_terms(curves[0].records, 25).error.l2;
        const double wavelets = at_terms(curves[1].records, 25).error.l2;
        found += fmt::format("{}{}: wavelets {:.2g}, harmonics {:.2g}",
                             found.empty() ? "" : "; ", light, wavelets, harmonics);
        holds = holds && wavelets <= harmonics;
    }
    return {.claim =
                "Under a soft sky 25 wavelets err a little less than 25 harmonics (5 % "
                "against 7 %): no more",
            .source = "[Ng03 §4.1.2]",
            .measure = "L2 of the image",
            .found = "table: " + found,
            .beside = "",
            .holds = holds,
            .why = holds
                       ? ""
                       : "A made-up overcast sky is a polynomial of low degree, but for the "
                         "horizon; six faces of Haar functions have first to find each other's "
                         "level."};
}

}  // namespace

std::vector<Claim> still_light_claims(Evidence& evidence) {
    const LabScene scene = evidence.scene_in_both_bases("table");
    return {photographed_light_claim(evidence, scene), outdoor_claim(evidence, scene),
            soft_sky_claim(evidence, scene)};
}

}  // namespace relume::lab
