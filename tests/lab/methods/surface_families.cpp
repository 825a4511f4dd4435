// Methods over a surface's vertices: factored, the first terms of every material, and cpca,
// clustered PCA. Both choose by PBI.
#include "protocol/relighting/strategy.h"
#include "tests/lab/methods/component_image.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/numbered_part.h"
#include "tests/lab/methods/session_contestant.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <fmt/format.h>

#include <stdexcept>

namespace relume::lab {
namespace {

// Of the components of a cluster, the part that is brought to its vertices in an image.
constexpr std::size_t kShare = 4;

relighting::Strategy pbi(const WaveletTerms& terms) {
    return {.method = relighting::Method::pbi, .priority = terms.priority};
}

void require_surface(const LabScene& scene) {
    if (!scene.haar->view_can_move()) {
        throw std::runtime_error(
            fmt::format("{}: of kind image; methods over a surface need kind mesh, baked with "
                        "relume-bake --receivers vertices",
                        scene.haar->transport().directory().string()));
    }
}

Method factored_method(std::string_view rest) {
    const std::uint32_t count = take_numbered_part('k', "the number of terms", rest);
    const WaveletTerms terms = wavelet_terms_from_text(rest);
    return {.label = fmt::format("factored-k{}-{}", count, terms.text),
            .enter = [count, terms](const LabScene& scene) {
                require_surface(scene);
                const auto fewer = scene.derived->leading_terms(*scene.haar, count);
                return session_over(fewer, pbi(terms), terms.budget, fewer->columns().count());
            }};
}

Method cpca_method(std::string_view rest) {
    const std::uint32_t clusters = take_numbered_part('c', "the number of clusters", rest);
    const std::uint32_t bases = take_numbered_part('s', "the bases of a cluster", rest);
    const WaveletTerms terms = wavelet_terms_from_text(rest);
    return {
        .label = fmt::format("cpca-c{}-s{}-{}", clusters, bases, terms.text),
        .enter = [clusters, bases, terms](const LabScene& scene) {
            require_surface(scene);
            const auto clustered =
                scene.derived->clustered(*scene.haar, {.clusters = clusters, .bases = bases});
            return std::make_unique<SessionContestant>(
                SessionParts{
                    .scene = scene.haar,
                    .workspace = std::make_shared<const engine::Workspace>(
                        std::make_shared<const engine::StoredOperator>(clustered->components)),
                    .image = std::make_unique<ComponentImageMaker>(
                        scene.haar, clustered, kShare,
                        std::make_unique<ViewImageMaker>(*scene.haar))},
                pbi(terms), terms.budget, scene.haar->columns().count());
        }};
}

}  // namespace

void add_surface_families(std::vector<MethodFamily>& families) {
    families.push_back({.name = "factored",
                        .form = "kTERMS-" + std::string(kWaveletTermsForm),
                        .summary = "pbi of a surface, the first terms of every material "
                                   "[Overbeck06T 7.2]",
                        .parse = factored_method});
    families.push_back({.name = "cpca",
                        .form = "cCLUSTERS-sBASES-" + std::string(kWaveletTermsForm),
                        .summary = "the same in clustered PCA, BI over S/4 [Overbeck06T 7.3]",
                        .parse = cpca_method});
}

}  // namespace relume::lab
