// A surface of several terms under a moving camera, plain and in clustered PCA.
#include "tests/lab/claims/claim.h"
#include "tests/lab/claims/comparison.h"
#include "tests/lab/measures/equal_cost.h"

#include <fmt/format.h>

#include <iterator>

namespace relume::lab {
namespace {

constexpr const char* kPbi = "factored-k4-30-area";
constexpr const char* kNwa = "nwa-100-area";
constexpr const char* kClustered = "cpca-c128-s25-100-area";
// Plain blocks at several budgets, to be read at the bytes of clustered PCA.
constexpr const char* kPlain[]{"factored-k4-5-area",  "factored-k4-10-area",
                               "factored-k4-20-area", kPbi,
                               "factored-k4-60-area", "factored-k4-100-area"};

Claim moving_claim(const std::vector<LightRun>& runs) {
    const auto ratio = [](Measure of) {
        return [of](const LightRun& run) { return ratio_of_means(run, kPbi, kNwa, of); };
    };
    const bool holds =
        under_all_lights(runs, [&](const LightRun& run) { return ratio(kImageL2)(run) <= 1; });
    return {
        .claim =
            "On glossy surfaces of four terms, light and view moving, 30 terms of PBI "
            "err no more than 100 of NWA: ratio of means ≤ 1",
        .source = "[Overbeck06T §7.2, fig. 7.2]",
        .measure = "images by eye; here L2 of the image",
        .found = by_light(runs, ratio(kImageL2)),
        .beside = "flicker: " +
                  by_light(runs, ratio({"flicker",
                                        [](const Record& record) { return record.flicker; }})),
        .holds = holds,
        .why = holds ? "" : "Where few lamps make the light, NWA needs few terms for them."};
}

Claim view_claim(const std::vector<LightRun>& runs) {
    const auto error = [](const char* method) {
        return [method](const LightRun& run) {
            return records_of(run.findings.records, method).back().error.l2;
        };
    };
    const bool holds = under_all_lights(
        runs, [&](const LightRun& run) { return 10 * error(kPbi)(run) <= error(kNwa)(run); });
    return {.claim =
                "While only the view changes, PBI converges and stays exact: after 40 images "
                "of 30 terms a tenth of the error of 100 terms of NWA",
            .source = "[Overbeck06T §7.2, fig. 7.2]",
            .measure = "images by eye; here L2 of the image",
            .found = by_light(runs, error(kPbi)),
            .beside = "NWA-100: " + by_light(runs, error(kNwa)),
            .holds = holds,
            .why = holds ? "" : "See the figures."};
}

double bytes_of(const LightRun& run, const char* method) {
    return run.of(method).bytes;
}

// The least error of plain blocks that read no more than clustered PCA does.
double plain_error_at_its_bytes(const LightRun& run) {
    std::vector<CostedMethod> plain;
    for (const char* method : kPlain) {
        plain.push_back({.series = "plain",
                         .at = {.cost = bytes_of(run, method), .error = run.of(method).l2}});
    }
    const double cost = bytes_of(run, kClustered);
    return errors_at_equal_cost(plain, {&cost, 1}).front().errors.front();
}

Claim clustered_claim(const std::vector<LightRun>& runs) {
    const auto error = [](const LightRun& run) { return run.of(kClustered).l2; };
    const bool holds = under_all_lights(runs, [&](const LightRun& run) {
        return !(plain_error_at_its_bytes(run) < error(run));
    });
    return {
        .claim =
            "Clustered PCA is the more compact: S = 25, 100 terms, 6 bases brought on "
            "an image, leave no more error than plain blocks of as many bytes",
        .source = "[Overbeck06T §7.3, fig. 7.3; Sloan03, Liu04]",
        .measure =
            "against dense rows; here L2 of the image against blocks in the Haar "
            "basis of their vertices",
        .found = fmt::format("clustered {}; plain {}", by_light(runs, error),
                             by_light(runs, plain_error_at_its_bytes)),
        .beside =
            "MB an image: " +
            by_light(runs, [](const LightRun& run) { return bytes_of(run, kClustered) / 1e6; }),
        .holds = holds,
        .why = holds ? ""
                     : "Columns are sparse in the Haar basis of the vertices, and a principal "
                       "component reaches over its whole cluster (cpca/README.md)."};
}

}  // namespace

std::vector<Claim> surface_claims(Evidence& evidence) {
    const LabScene street = evidence.surface("street");
    std::vector<LightRun> moving;
    std::vector<LightRun> view_only;
    std::vector<std::string> methods{kNwa, kClustered};
    methods.insert(methods.end(), std::begin(kPlain), std::end(kPlain));
    for (const std::string& light : evidence.lights()) {
        moving.push_back(evidence.run(street, light, "turn-and-orbit", methods));
        view_only.push_back(evidence.run(street, light, "orbit", {kPbi, kNwa}));
    }
    return {moving_claim(moving), view_claim(view_only), clustered_claim(moving)};
}

}  // namespace relume::lab
