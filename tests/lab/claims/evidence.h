// The experiments that claims rest on, each run once.
#pragma once

#include "tests/lab/measures/experiment.h"
#include "tests/lab/measures/summary.h"
#include "tests/lab/measures/terms_sweep.h"
#include "tests/lab/scenes/lab_scenes.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace relume::lab {

// Thrown out of an experiment that was asked to stop.
class EvidenceInterrupted : public std::runtime_error {
  public:
    EvidenceInterrupted() : std::runtime_error("interrupted") {}
};

struct EvidenceOptions {
    LabScene demo;  // what most claims are tried on
    std::vector<std::string> lights{"studio", "night", "courtyard"};  // as load_environment
    std::string cache = {};  // of the scenes of claims about materials
    // Told what is running and how many of its images or curves are done; false: stop.
    std::function<bool(const std::string& what, std::uint32_t done, std::uint32_t of)> go_on;
};

// One light's run.
struct LightRun {
    std::string light;
    Findings findings;
    std::vector<Summary> summaries;
    std::uint32_t rests_from = 0;  // the first image in which the light rests

    // Throws std::invalid_argument when the method did not take part.
    [[nodiscard]] const Summary& of(const std::string& method) const;
};

// Not thread-safe.
class Evidence {
  public:
    explicit Evidence(EvidenceOptions options);

    [[nodiscard]] const LabScene& demo() const { return options_.demo; }
    // A built-in scene as the lab bakes it, 128².
    [[nodiscard]] LabScene scene(const std::string& builtin);
    // The same with the view in spherical harmonics of order 20 beside it.
    [[nodiscard]] LabScene scene_in_both_bases(const std::string& builtin);

    // A built-in scene's surface: at most 10,000 vertices, 4 terms, images of 256².
    [[nodiscard]] LabScene surface(const std::string& builtin);

    // The demo scene under every light, slow-fast-slow: NWA with ever more terms, BI with 30,
    // PBI with 30 and 100, PBI-30 with the other selectors and norms, all by area.
    [[nodiscard]] const std::vector<LightRun>& rotations();
    static constexpr std::array<std::uint32_t, 8> kTermsOfNwa{30,  60,  100, 150,
                                                              200, 300, 500, 1000};

    // Any methods over any sequence; not kept. `blended_with` is the sequence's second light.
    [[nodiscard]] LightRun run(const LabScene& scene,
                               const std::string& light,
                               const std::string& sequence,
                               const std::vector<std::string>& methods,
                               const std::string& blended_with = {});
    // The first light of slow-fast-slow with ever more terms, a curve for each of `forms`
    // (sweep_terms); not kept.
    [[nodiscard]] std::vector<TermsCurve> terms(const LabScene& scene,
                                                const std::string& light,
                                                const std::vector<std::string>& forms);
    [[nodiscard]] const std::vector<std::string>& lights() const { return options_.lights; }

  private:
    [[nodiscard]] LabScenes& scenes();

    EvidenceOptions options_;
    std::optional<LabScenes> scenes_;
    std::vector<LightRun> rotations_;
};

// "studio 0.81, night 1.02": a number of every light.
[[nodiscard]] std::string by_light(const std::vector<LightRun>& runs,
                                   const std::function<double(const LightRun&)>& value);
// Whether it is true of every light.
[[nodiscard]] bool under_all_lights(const std::vector<LightRun>& runs,
                                    const std::function<bool(const LightRun&)>& is_true);

}  // namespace relume::lab
