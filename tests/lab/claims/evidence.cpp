#include "tests/lab/claims/evidence.h"

#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace relume::lab {
namespace {

// No method takes part yet.
Experiment experiment_under(const LabScene& scene,
                            const std::string& light,
                            const std::string& sequence) {
    Experiment experiment;
    experiment.scene = scene;
    experiment.sequence = load_sequence(sequence);
    experiment.environments = {
        .environment = load_environment(light, scene.haar->face_resolution()),
        .blend = nullptr};
    return experiment;
}

std::string name_of(const LabScene& scene, const std::string& light) {
    return scene.haar->transport().directory().stem().string() + ", " + light;
}

}  // namespace

const Summary& LightRun::of(const std::string& method) const {
    const auto found =
        std::find_if(summaries.begin(), summaries.end(),
                     [&](const Summary& summary) { return summary.method == method; });
    if (found == summaries.end()) {
        throw std::invalid_argument(fmt::format("method '{}' did not take part", method));
    }
    return *found;
}

Evidence::Evidence(EvidenceOptions options) : options_(std::move(options)) {}

LabScenes& Evidence::scenes() {
    if (!scenes_) {
        scenes_.emplace(options_.cache);
    }
    return *scenes_;
}

LabScene Evidence::scene(const std::string& builtin) {
    return {.haar = scenes().scene(builtin), .sh_transport = {}};
}

LabScene Evidence::scene_in_both_bases(const std::string& builtin) {
    return {.haar = scenes().scene(builtin), .sh_transport = scenes().sh_transport(builtin)};
}

LabScene Evidence::surface(const std::string& builtin) {
    return {.haar = scenes().surface({.scene = builtin, .vertices = 10'000, .side = 256}),
            .sh_transport = {}};
}

const std::vector<LightRun>& Evidence::rotations() {
    if (rotations_.empty()) {
        std::vector<LightRun> runs;
        for (const std::string& light : options_.lights) {
            std::vector<std::string> methods{"bi-30",
                                             "pbi-30",
                                             "pbi-100",
                                             "pbi-l2-30",
                                             "pbi-dealer-30",
                                             "pbi-dealer-l2-30",
                                             "pbi-exhaustive-30",
                                             "pbi-exhaustive-l2-30"};
            for (const std::uint32_t terms : kTermsOfNwa) {
                methods.push_back(fmt::format("nwa-{}", terms));
            }
            runs.push_back(run(demo(), light, "slow-fast-slow", methods));
        }
        rotations_ = std::move(runs);
    }
    return rotations_;
}

LightRun Evidence::run(const LabScene& scene,
                       const std::string& light,
                       const std::string& sequence,
                       const std::vector<std::string>& methods,
                       const std::string& blended_with) {
    Experiment experiment = experiment_under(scene, light, sequence);
    if (!blended_with.empty()) {
        experiment.environments.blend =
            load_environment(blended_with, scene.haar->face_resolution());
    }
    for (const std::string& method : methods) {
        experiment.methods.push_back(method_from_text(method));
    }
    const std::string what = name_of(scene, light);
    experiment.go_on = [&](std::uint32_t done) {
        return options_.go_on(what, done, experiment.sequence.images);
    };
    (void)options_.go_on(what, 0, experiment.sequence.images);
    LightRun run{.light = light,
                 .findings = run_experiment(experiment),
                 .summaries = {},
                 .rests_from = experiment.sequence.rests_from()};
    if (!run.findings.complete) {
        throw EvidenceInterrupted();
    }
    run.summaries = summaries(run.findings.records, experiment.sequence.rests_from());
    return run;
}

std::vector<TermsCurve> Evidence::terms(const LabScene& scene,
                                        const std::string& light,
                                        const std::vector<std::string>& forms) {
    const Experiment experiment = experiment_under(scene, light, "slow-fast-slow");
    const std::string what = name_of(scene, light) + ", terms";
    const auto all = static_cast<std::uint32_t>(forms.size());
    std::vector<TermsCurve> curves;
    for (const std::string& form : forms) {
        const auto done = static_cast<std::uint32_t>(curves.size());
        if (!options_.go_on(what, done, all)) {
            throw EvidenceInterrupted();
        }
        curves.push_back(sweep_terms(experiment, {form}).front());
    }
    (void)options_.go_on(what, all, all);
    return curves;
}

std::string by_light(const std::vector<LightRun>& runs,
                     const std::function<double(const LightRun&)>& value) {
    std::string text;
    for (const LightRun& run : runs) {
        text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", run.light, value(run));
    }
    return text;
}

bool under_all_lights(const std::vector<LightRun>& runs,
                      const std::function<bool(const LightRun&)>& is_true) {
    return std::all_of(runs.begin(), runs.end(), is_true);
}

}  // namespace relume::lab
