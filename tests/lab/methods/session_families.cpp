// The methods of the engine's own sessions: what the server runs.
#include "protocol/wire/session_names.h"
#include "server/engine/session.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/haar_radiance.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <fmt/format.h>

#include <utility>

namespace relume::lab {
namespace {

class SessionContestant final : public Contestant {
  public:
    SessionContestant(std::shared_ptr<const engine::Scene> scene,
                      wire::Strategy strategy,
                      const engine::SelectionBudget& budget)
        : session_(std::move(scene), strategy), budget_(budget) {}

    void set_light(const ImageLight& light) override {
        target_.assign(light.haar.begin(), light.haar.end());
        session_.set_lighting(target_);
    }
    Step step() override {
        const engine::StepReport report = session_.advance_incrementally(budget_);
        return {.applied = report.applied,
                .bands_reset = report.bands_reset,
                .bytes = report.bytes_touched,
                .stated_error = report.stated_error};
    }
    void write_image(std::span<float> rgb) const override { session_.write_image(rgb); }
    [[nodiscard]] LightingView lighting() const override {
        return {.target = target_,
                .approximation = session_.approximation(),
                .bands = session_.scene().bands()};
    }
    void write_radiance(light::LightCubemap& out) const override {
        radiance_from_haar(session_.approximation(), session_.scene().face_resolution(), out);
    }

  private:
    engine::Session session_;
    engine::SelectionBudget budget_;
    std::vector<float> target_;
};

MethodFamily session_family(wire::Method method, std::string summary) {
    const std::string name(wire::name_from(method));
    return {.name = name,
            .form = std::string(kWaveletTermsForm),
            .summary = std::move(summary),
            .parse = [name, method](std::string_view rest) {
                const WaveletTerms terms = wavelet_terms_from_text(rest);
                return Method{
                    .label = name + "-" + terms.text,
                    .enter = [method, terms](const LabScene& scene) {
                        return std::make_unique<SessionContestant>(
                            scene.haar,
                            wire::Strategy{.method = method, .priority = terms.priority},
                            terms.budget);
                    }};
            }};
}

}  // namespace

void add_session_families(std::vector<MethodFamily>& families) {
    families.push_back(session_family(wire::Method::nwa,
                                      "the best terms of the light, anew each image [Ng03]"));
    families.push_back(
        session_family(wire::Method::bi, "the best terms of the difference [Overbeck06 §3]"));
    families.push_back(session_family(
        wire::Method::pbi, "bi, bands begin anew where that is nearer [Overbeck06 §5]"));
    families.push_back(session_family(wire::Method::guarded,
                                      "bi, bands begin anew by the predicted image error"));
}

}  // namespace relume::lab
