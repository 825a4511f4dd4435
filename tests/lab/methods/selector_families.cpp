// PBI with the band selectors of the thesis, made of the engine's parts.
#include "protocol/relighting/strategy.h"
#include "server/engine/choosing/ranking.h"
#include "server/engine/choosing/selection.h"
#include "tests/lab/methods/band_selector.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/planned_contestant.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

using MakeSelector = std::unique_ptr<BandSelector> (*)(Norm);

// The selector's resets, then the most important differences.
class SelectorPlanMaker final : public PlanMaker {
  public:
    SelectorPlanMaker(const WaveletTerms& terms, std::unique_ptr<BandSelector> selector)
        : budget_(terms.budget), priority_(terms.priority), selector_(std::move(selector)) {}

    void make(const served::Scene& scene,
              const engine::SignalState& lighting,
              engine::Plan& plan) override {
        ranking_.rank(scene.columns(), lighting, scene.columns().weights(priority_));
        plan.bands_to_reset = selector_->bands_to_reset(
            {.scene = scene, .lighting = lighting, .ranking = ranking_, .budget = budget_});
        selection_.choose(scene.columns(), lighting, ranking_, scene.columns().places(), budget_, plan);
    }

  private:
    engine::SelectionBudget budget_;
    relighting::Priority priority_;
    std::unique_ptr<BandSelector> selector_;
    engine::Ranking ranking_;
    engine::Selection selection_;
};

MethodFamily selector_family(std::string name,
                             std::string summary,
                             MakeSelector make_selector,
                             Norm norm) {
    const auto parse = [name, make_selector, norm](std::string_view rest) {
        const WaveletTerms terms = wavelet_terms_from_text(rest);
        if (terms.counts_bytes()) {
            throw std::invalid_argument(
                "its terms are counted: expected a number of coefficients, not of bytes");
        }
        return Method{.label = name + "-" + terms.text,
                      .enter = [terms, make_selector, norm](const LabScene& scene) {
                          return std::make_unique<PlannedContestant>(
                              scene.haar,
                              std::make_unique<SelectorPlanMaker>(terms, make_selector(norm)));
                      }};
    };
    return {.name = std::move(name),
            .form = std::string(kWaveletTermsForm),
            .summary = std::move(summary),
            .parse = parse};
}

}  // namespace

void add_selector_families(std::vector<MethodFamily>& families) {
    families.push_back(selector_family("pbi-l2", "pbi, the norm of a band L2 [Overbeck06T 6.2]",
                                       make_simple_selector, Norm::l2));
    families.push_back(selector_family("pbi-dealer",
                                       "pbi, terms are dealt to bands [Overbeck06T 6.2]",
                                       make_dealer_selector, Norm::l1));
    families.push_back(selector_family("pbi-dealer-l2", "the same, the norm L2",
                                       make_dealer_selector, Norm::l2));
    families.push_back(selector_family("pbi-exhaustive",
                                       "pbi, the best of all sets of bands [Overbeck06T 6.2]",
                                       make_exhaustive_selector, Norm::l1));
    families.push_back(selector_family("pbi-exhaustive-l2", "the same, the norm L2",
                                       make_exhaustive_selector, Norm::l2));
}

}  // namespace relume::lab
