#include "tests/stability/findings_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace relume::stability {
namespace {

constexpr const char* kSenseNames[] = {"at most", "at least", "reported"};

const char* name_from(Sense sense) {
    return kSenseNames[static_cast<std::size_t>(sense)];
}

}  // namespace

bool Result::holds() const {
    return std::all_of(outcome.findings.begin(), outcome.findings.end(),
                       [](const Finding& finding) { return finding.holds(); });
}

std::string bound_text(const Finding& finding) {
    return finding.sense == Sense::reported
               ? "none"
               : fmt::format("{} {:.3g}", name_from(finding.sense), finding.bound);
}

std::string verdict_text(const Finding& finding) {
    if (!finding.holds()) {
        return "broken";
    }
    return finding.sense == Sense::reported ? "reported" : "holds";
}

std::string line_from(const Finding& finding) {
    return fmt::format("{:<8}  {:>10.3g}  {:<18}  {}", verdict_text(finding), finding.measured,
                       bound_text(finding), finding.measure);
}

std::string text_from(const Result& result) {
    std::string text = fmt::format("{}: {}\n  {}\n", result.failure.name, result.failure.what,
                                   result.failure.scene);
    for (const Finding& finding : result.outcome.findings) {
        text += "  " + line_from(finding) + "\n";
    }
    return text;
}

nlohmann::json json_from(std::span<const Result> results) {
    nlohmann::json failures = nlohmann::json::array();
    for (const Result& result : results) {
        nlohmann::json findings = nlohmann::json::array();
        for (const Finding& finding : result.outcome.findings) {
            nlohmann::json entry{{"measure", finding.measure},
                                 {"sense", name_from(finding.sense)},
                                 {"measured", finding.measured},
                                 {"reason", finding.reason},
                                 {"holds", finding.holds()}};
            if (finding.sense != Sense::reported) {
                entry["bound"] = finding.bound;
            }
            findings.push_back(std::move(entry));
        }
        failures.push_back({{"name", result.failure.name},
                            {"what", result.failure.what},
                            {"scene", result.failure.scene},
                            {"holds", result.holds()},
                            {"findings", std::move(findings)}});
    }
    return {{"failures", std::move(failures)}};
}

}  // namespace relume::stability
