// What PBI costs beyond NWA.
#include "tests/lab/claims/claim.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace relume::lab {
namespace {

std::vector<double> microseconds_of(const LightRun& run, const std::string& method) {
    std::vector<double> times;
    for (const Record& record : records_of(run.findings.records, method)) {
        times.push_back(record.microseconds);
    }
    return times;
}

Claim time_claim(Evidence& evidence, std::uint32_t terms, double overhead) {
    const std::string pbi = fmt::format("pbi-{}-area", terms);
    const std::string nwa = fmt::format("nwa-{}-area", terms);
    const std::string bi = fmt::format("bi-{}-area", terms);
    const LightRun run = evidence.run(evidence.demo(), evidence.lights().front(),
                                      "slow-fast-slow", {nwa, bi, pbi});
    const std::vector<double> times = microseconds_of(run, pbi);
    const double over_nwa = test::median_ratio(times, microseconds_of(run, nwa));
    const double over_bi = test::median_ratio(times, microseconds_of(run, bi));
    const double bytes = run.of(pbi).bytes / run.of(nwa).bytes;
    const bool holds = over_nwa <= 1 + overhead;
    return {
        .claim =
            fmt::format("With {} {} PBI takes at most {:.0f} % longer than NWA: ratio ≤ {}",
                        terms, terms == 1 ? "term" : "terms", 100 * overhead, 1 + overhead),
        .source = "[Overbeck06T §6.3]",
        .measure = "time of an image",
        .found = fmt::format("{}, median of the ratios image by image: PBI over NWA {:.3f}, "
                             "PBI over BI {:.3f}; PBI reads {:.2f} of NWA's bytes",
                             run.light, over_nwa, over_bi, bytes),
        .beside = "",
        .holds = holds,
        .why = holds ? ""
                     : "Our NWA does all that PBI does but the sum over bands; the ratio is "
                       "that of the fixed work of an image to its columns, which the paper's "
                       "larger images outweigh."};
}

Claim memory_claim(Evidence& evidence) {
    constexpr double kPart = 0.08;
    const served::Scene& scene = *evidence.demo().haar;
    const LightRun run =
        evidence.run(evidence.demo(), evidence.lights().front(), "slow-fast-slow", {"pbi-30"});
    std::uint64_t held = 0;
    for (const Record& record : records_of(run.findings.records, "pbi-30-area")) {
        held = std::max(held, record.band_bytes);
    }
    const std::size_t image = scene.stored_operator().sum_count() * sizeof(float);
    const std::size_t lighting =
        transport::kColours * scene.columns().count() * sizeof(float);
    const auto extra = static_cast<double>(held + lighting);
    const auto transport = static_cast<double>(scene.transport().total_bytes());
    const double part = extra / transport;
    const bool holds = part <= kPart;
    return {
        .claim = "PBI adds 8 % of the transport's memory (19.2 of 229 MB): no more",
        .source = "[Overbeck06T §6.3]",
        .measure = "bytes",
        .found = fmt::format(
            "{}, at most over the images: for the bands {:.3f} MB, one lighting {:.2f} MB, "
            "together {:.1f} % of {:.1f} MB of transport; an image for each of {} bands, as in "
            "the paper, would be {:.2f} MB",
            run.light, static_cast<double>(held) / 1e6, static_cast<double>(lighting) / 1e6,
            100 * part, transport / 1e6, scene.columns().band_count(),
            static_cast<double>(scene.columns().band_count() * image) / 1e6),
        .beside = "",
        .holds = holds,
        .why = holds ? ""
                     : "Our transport is stored in few bytes, of which this is a larger part."};
}

}  // namespace

std::vector<Claim> cost_claims(Evidence& evidence) {
    return {time_claim(evidence, 30, 0.05), time_claim(evidence, 1, 0.2),
            memory_claim(evidence)};
}

}  // namespace relume::lab
