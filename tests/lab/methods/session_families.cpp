// The methods of the engine's own sessions: what the server runs.
#include "protocol/relighting/strategy.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/session_contestant.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

MethodFamily session_family(relighting::Method method, std::string summary) {
    const std::string name(relighting::name_from(method));
    return {.name = name,
            .form = std::string(kWaveletTermsForm),
            .summary = std::move(summary),
            .parse = [name, method](std::string_view rest) {
                const WaveletTerms terms = wavelet_terms_from_text(rest);
                return Method{.label = name + "-" + terms.text,
                              .enter = [method, terms](const LabScene& scene) {
                                  return session_over(
                                      scene.haar,
                                      {.method = method, .priority = terms.priority},
                                      terms.budget, scene.haar->columns().count());
                              }};
            }};
}

Method whole_product(std::string_view rest) {
    if (rest != "product") {
        throw std::invalid_argument(fmt::format("'{}', expected product", rest));
    }
    return {.label = "full-product", .enter = [](const LabScene& scene) {
                return session_over(scene.haar, {}, std::nullopt,
                                    scene.haar->columns().count());
            }};
}

}  // namespace

void add_session_families(std::vector<MethodFamily>& families) {
    families.push_back(session_family(relighting::Method::nwa,
                                      "the best terms of the light, anew each image [Ng03]"));
    families.push_back(session_family(relighting::Method::bi,
                                      "the best terms of the difference [Overbeck06 §3]"));
    families.push_back(session_family(
        relighting::Method::pbi, "bi, bands begin anew where that is nearer [Overbeck06 §5]"));
    families.push_back(session_family(relighting::Method::guarded,
                                      "bi, bands begin anew by the predicted image error"));
    families.push_back({.name = "full",
                        .form = "product",
                        .summary = "the whole transport, each image",
                        .parse = whole_product});
}

}  // namespace relume::lab
