// A studio creeps round. The image hardly changes, but which coefficients are the k largest
// does.
#include "protocol/relighting/strategy.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::stability {
namespace {

constexpr float kDegreesPerImage = 0.3F;
constexpr std::uint32_t kAll = ~std::uint32_t{0};

struct Popping {
    RelitRun run;
    double energy = 0;  // Σ‖Δ(B̃ − B)‖² / Σ‖ΔB‖²; a frozen image has 1
    std::size_t worst_image = 1;  // of the largest ‖Δ(B̃ − B)‖
};

Popping measure(const std::shared_ptr<const served::Scene>& scene,
                relighting::Method method,
                std::uint32_t columns,
                std::span<const Lighting> lightings,
                std::span<const RelitImage> exact) {
    Popping popping;
    popping.run = relight_in_turn(
        scene, {.method = method, .priority = relighting::Priority::area}, columns, lightings);
    double change = 0;
    double exact_change = 0;
    double largest = 0;
    // The first quarter is for the incremental methods to arrive.
    for (std::size_t i = exact.size() / 4; i < exact.size(); ++i) {
        const double jump = error_change(popping.run.images[i - 1], exact[i - 1],
                                         popping.run.images[i], exact[i]);
        if (jump > largest) {
            largest = jump;
            popping.worst_image = i;
        }
        change += jump * jump;
        exact_change += std::pow(distance(exact[i], exact[i - 1]), 2);
    }
    popping.energy = change / exact_change;
    return popping;
}

Outcome provoke(Workbench& workbench) {
    const auto scene = workbench.baked("table");
    const auto lightings =
        turning_environment(lab::load_environment("studio", scene->face_resolution()),
                            kDegreesPerImage, workbench.choose(60U, 300U));
    const auto exact = exact_images(scene, lightings);
    const auto measured = [&](relighting::Method method, std::uint32_t columns) {
        return measure(scene, method, columns, lightings, exact);
    };
    const Popping nwa = measured(relighting::Method::nwa, 30);
    workbench.progress("popping", 0.3);
    const Popping more = measured(relighting::Method::nwa, 100);
    const Popping all = measured(relighting::Method::nwa, kAll);
    workbench.progress("popping", 0.6);
    const Popping pbi = measured(relighting::Method::pbi, 30);
    const Popping guarded = measured(relighting::Method::guarded, 30);
    const Popping guarded_more = measured(relighting::Method::guarded, 100);

    // Of a float image's rounding, ε‖B‖ an image, in the change of the exact image.
    double rounding = 0;
    for (std::size_t i = exact.size() / 4; i < exact.size(); ++i) {
        constexpr double kEpsilon = std::numeric_limits<float>::epsilon();
        rounding = std::max(rounding, 2 * std::sqrt(double{100}) * kEpsilon * norm(exact[i]) /
                                          distance(exact[i], exact[i - 1]));
    }
    constexpr const char* kFrozen =
        "1 is an image that never changes: more, and it moves where nothing does";
    Outcome outcome;
    outcome.findings = {
        {"NWA-30: popping Σ‖Δ(B̃−B)‖²/Σ‖ΔB‖²", Sense::at_least, 1, nwa.energy, kFrozen},
        {"NWA-100: the same", Sense::at_most, 1, more.energy,
         "a hundred terms move less than a frozen image is wrong by"},
        {"NWA with all terms: the same", Sense::at_most, rounding * rounding, all.energy,
         "rounding of float sums alone: 2·10·ε‖B‖ an image"},
        {"PBI-30: the same, of NWA-30's", Sense::at_most, 1, pbi.energy / nwa.energy,
         "what it has taken stays until it changes"},
        {"guarded-30: the same, of NWA-30's", Sense::at_most, 1, guarded.energy / nwa.energy,
         "as above"},
        {"PBI-30: popping", Sense::reported, 0, pbi.energy,
         "above 1 thirty columns an image are too few to follow without steps"},
        {"guarded-30: popping", Sense::reported, 0, guarded.energy, "as above"},
        {"guarded-100: popping", Sense::at_most, 1, guarded_more.energy, kFrozen},
    };
    const std::size_t at = nwa.worst_image;
    const float exposure = exposure_for(exact[at]);
    const auto change_tile = [&](const char* name, const RelitImage& now,
                                 const RelitImage& before) {
        constexpr float kGain = 20;
        return Tile{absolute_difference(now, before, kGain), name, exposure};
    };
    outcome.tiles = {
        {exact[at], fmt::format("exact, image {}", at), exposure},
        change_tile("exact: 20x change to it", exact[at], exact[at - 1]),
        change_tile("NWA-30: 20x change", nwa.run.images[at], nwa.run.images[at - 1]),
        change_tile("guarded-30: 20x change", guarded.run.images[at],
                    guarded.run.images[at - 1])};
    return outcome;
}

}  // namespace

Failure popping() {
    return {.name = "popping",
            .what = "coefficients that cross the threshold switch on and off",
            .scene = "table, n = 32; the CC0 map studio turns by 0.3 degrees an image",
            .provoke = provoke};
}

}  // namespace relume::stability
