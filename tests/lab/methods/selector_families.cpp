// PBI with the band selectors of the thesis, made of the engine's parts.
#include "server/engine/band_images.h"
#include "server/engine/error_estimate.h"
#include "server/engine/relit_image.h"
#include "tests/lab/methods/band_selector.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/light_radiance.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

class SelectorContestant final : public Contestant {
  public:
    SelectorContestant(std::shared_ptr<const engine::Scene> scene,
                       const WaveletTerms& terms,
                       std::unique_ptr<BandSelector> selector)
        : scene_(std::move(scene)),
          budget_(terms.budget),
          priority_(terms.priority),
          selector_(std::move(selector)),
          lighting_(*scene_),
          lit_(*scene_),
          images_(*scene_),
          error_(*scene_) {}

    void set_light(const ImageLight& light) override { lighting_.set_target(light.haar); }
    Step step() override {
        lit_.set_nearly(lighting_.target(), engine::kSurelyNegligible);
        error_.set_target(lit_);
        ranking_.rank(*scene_, lighting_, scene_->weights(priority_));
        plan_.bands_to_reset = selector_->bands_to_reset(
            {.scene = *scene_, .lighting = lighting_, .ranking = ranking_, .budget = budget_});
        selection_.choose(*scene_, lighting_, ranking_, scene_->places(), budget_, plan_);
        images_.update(plan_.bands_to_reset, plan_.changes);
        lighting_.apply(plan_);
        error_.apply(plan_);
        return {.applied = static_cast<std::uint32_t>(plan_.changes.size()),
                .bands_reset = plan_.bands_to_reset,
                .bytes = plan_.bytes,
                .band_bytes = images_.bytes_of_bands(),
                .stated_error = error_.relative_l2()};
    }
    void write_image(std::span<float> rgb) const override {
        engine::write_relit_image(*scene_, images_.total(), rgb);
    }
    [[nodiscard]] LightingView lighting() const override {
        return {.target = lighting_.target(),
                .approximation = lighting_.approximation(),
                .bands = scene_->bands()};
    }
    void write_radiance(light::LightCubemap& out) const override {
        radiance_from_coefficients(lighting_.approximation(), scene_->projection(), out);
    }

  private:
    std::shared_ptr<const engine::Scene> scene_;
    engine::SelectionBudget budget_;
    wire::Priority priority_;
    std::unique_ptr<BandSelector> selector_;
    engine::Lighting lighting_;
    engine::LitColumns lit_;
    engine::Ranking ranking_;
    engine::Selection selection_;
    engine::Plan plan_;
    engine::BandImages images_;
    engine::ErrorEstimate error_;
};

MethodFamily selector_family(std::string name,
                             std::string summary,
                             std::unique_ptr<BandSelector> (*make_selector)()) {
    return {.name = name,
            .form = std::string(kWaveletTermsForm),
            .summary = std::move(summary),
            .parse = [name, make_selector](std::string_view rest) {
                const WaveletTerms terms = wavelet_terms_from_text(rest);
                if (terms.counts_bytes()) {
                    throw std::invalid_argument(
                        "its terms are counted: expected a number of "
                        "coefficients, not of bytes");
                }
                return Method{.label = name + "-" + terms.text,
                              .enter = [terms, make_selector](const LabScene& scene) {
                                  return std::make_unique<SelectorContestant>(scene.haar, terms,
                                                                              make_selector());
                              }};
            }};
}

}  // namespace

void add_selector_families(std::vector<MethodFamily>& families) {
    families.push_back(selector_family(
        "pbi-dealer", "bi, terms are dealt to bands [thesis 6.2]", make_dealer_selector));
    families.push_back(selector_family("pbi-exhaustive",
                                       "bi, the best of all sets of bands [thesis 6.2]",
                                       make_exhaustive_selector));
}

}  // namespace relume::lab
