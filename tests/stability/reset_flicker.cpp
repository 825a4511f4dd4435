// A night with lamps turns at a speed at which bands keep changing their mind between going on
// and beginning anew.
#include "protocol/relighting/strategy.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t kColumns = 10;
constexpr float kDegreesPerImage = 3;

struct Flicker {
    std::size_t toggles = 0;  // bands reset in an image and not in the one before
    double worst_reset = 0;   // largest error after a reset, of the error had nothing changed
    std::size_t worst_image = 1;  // where that was
    double energy = 0;  // Σ‖Δ(B̃ − B)‖² / Σ‖ΔB‖²; a frozen image has 1
};

Flicker flicker_of(const RelitRun& run, std::span<const RelitImage> exact) {
    Flicker flicker;
    double change = 0;
    double exact_change = 0;
    for (std::size_t i = 1; i < exact.size(); ++i) {
        const std::uint32_t reset = run.steps[i].bands_reset;
        flicker.toggles +=
            static_cast<std::size_t>(std::popcount(reset & ~run.steps[i - 1].bands_reset));
        if (reset != 0) {
            const double ratio =
                distance(run.images[i], exact[i]) / distance(run.images[i - 1], exact[i]);
            if (ratio > flicker.worst_reset) {
                flicker.worst_reset = ratio;
                flicker.worst_image = i;
            }
        }
        change +=
            std::pow(error_change(run.images[i - 1], exact[i - 1], run.images[i], exact[i]), 2);
        exact_change += std::pow(distance(exact[i], exact[i - 1]), 2);
    }
    flicker.energy = change / exact_change;
    return flicker;
}

// Resets of one band at most, when the same lighting is sent again and again.
double resets_at_rest(const std::shared_ptr<const served::Scene>& scene,
                      std::span<const Lighting> moving) {
    constexpr std::size_t kAgain = 60;
    std::vector<Lighting> lightings(moving.begin(), moving.end());
    lightings.insert(lightings.end(), kAgain, moving.back());
    const RelitRun run = relight_in_turn(
        scene, {.method = relighting::Method::pbi, .priority = relighting::Priority::area},
        kColumns, lightings);
    std::vector<double> resets(scene->columns().band_count());
    for (std::size_t i = moving.size(); i < run.steps.size(); ++i) {
        for (std::size_t band = 0; band < resets.size(); ++band) {
            resets[band] += (run.steps[i].bands_reset >> band) & 1U;
        }
    }
    return *std::max_element(resets.begin(), resets.end());
}

Outcome provoke(Workbench& workbench) {
    const auto scene = workbench.baked("table");
    const auto lightings =
        turning_environment(lab::load_environment("night", scene->face_resolution()),
                            kDegreesPerImage, workbench.choose(60U, 240U));
    const auto exact = exact_images(scene, lightings);
    workbench.progress("reset_flicker", 0.3);
    const auto run_of = [&](relighting::Method method) {
        return relight_in_turn(scene,
                               {.method = method, .priority = relighting::Priority::area},
                               kColumns, lightings);
    };
    const Flicker nwa = flicker_of(run_of(relighting::Method::nwa), exact);
    const RelitRun pbi_run = run_of(relighting::Method::pbi);
    const RelitRun guarded_run = run_of(relighting::Method::guarded);
    const Flicker pbi = flicker_of(pbi_run, exact);
    const Flicker guarded = flicker_of(guarded_run, exact);
    workbench.progress("reset_flicker", 0.8);

    const double deviation = 3 / std::sqrt(128.0);
    Outcome outcome;
    outcome.findings = {
        {"PBI-10: times a band went from increment to reset", Sense::at_least, 10,
         static_cast<double>(pbi.toggles), "the scene makes bands toggle"},
        {"PBI-10: error after the worst reset, of the error had nothing changed",
         Sense::at_least, 1, pbi.worst_reset,
         "PBI decides by the lighting; in the image a reset can be a step back"},
        {"guarded-10: the same", Sense::at_most, (1 + deviation) / (1 - deviation),
         guarded.worst_reset,
         "a reset must bring the image nearer than it stands; judged by 64 rows, three "
         "standard "
         "deviations of 1/√128 either way"},
        {"PBI-10: flicker Σ‖Δ(B̃−B)‖²/Σ‖ΔB‖², of NWA-10's", Sense::at_most, 1,
         pbi.energy / nwa.energy, "PBI forgets some bands, NWA all of them each image"},
        {"guarded-10: the same, of NWA-10's", Sense::at_most, 1, guarded.energy / nwa.energy,
         "as above"},
        {"PBI-10: flicker, an image that never changes having 1", Sense::reported, 0,
         pbi.energy, "ten columns are few"},
        {"guarded-10: the same", Sense::reported, 0, guarded.energy, "as above"},
        {"PBI-10: resets of one band while the same light is sent 60 times", Sense::at_most, 1,
         resets_at_rest(scene, std::span(lightings).first(lightings.size() / 2)),
         "after a reset ‖L−L̃‖₁ ≤ ‖L‖₁, and under the same light it only falls"},
    };
    const std::size_t at = pbi.worst_image;
    const float exposure = exposure_for(exact[at]);
    constexpr float kGain = 2;
    for (const auto& [name, run] :
         {std::pair{"PBI-10", &pbi_run}, std::pair{"guarded-10", &guarded_run}}) {
        for (const std::size_t i : {at - 1, at}) {
            outcome.tiles.push_back(
                {run->images[i],
                 fmt::format("{}, image {}, reset 0b{:b}", name, i, run->steps[i].bands_reset),
                 exposure});
            outcome.tiles.push_back(
                {absolute_difference(run->images[i], exact[i], kGain),
                 fmt::format("2x error, {:.3f}",
                             distance(run->images[i], exact[i]) / norm(exact[i])),
                 exposure});
        }
    }
    return outcome;
}

}  // namespace

Failure reset_flicker() {
    return {.name = "reset_flicker",
            .what = "a band toggles between reset and increment",
            .scene = "table, n = 32; the CC0 map night turns by 3 degrees an image",
            .provoke = provoke};
}

}  // namespace relume::stability
