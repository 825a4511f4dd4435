// A light jumps and then rests: from there on each image should be nearer than the one before.
#include "protocol/relighting/strategy.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/stability/band_norms.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace relume::stability {
namespace {

constexpr std::uint32_t kColumns = 30;
constexpr float kJumpDegrees = 110;
// Of the image: by so much it may move when sums are made anew, whatever columns are taken, and
// be they black.
constexpr double kRounding = 1e-5;

struct Rest {
    double lighting_rise = 0;  // largest rise of ‖L−L̃‖₁ from image to image, of ‖L‖₁
    double image_rise = 0;  // largest error of the image over that of the one before
    double rising = 0;      // images whose error is larger than that of the one before
    double images = 0;
    double beyond_triangle = 0;  // largest rise of ‖B−B̃‖ over Σ|ΔL|‖T‖ of the columns taken
    double end_error = 0;  // relative L2 with all columns taken
    RelitImage before;     // of the largest rise, and after it
    RelitImage after;
    double before_error = 0;
    double after_error = 0;
};

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// Σ_j Σ_c |ΔL(j,c)|·‖T_j‖: by the triangle inequality, the most that an image can move.
double longest_step(const served::Scene& scene,
                    std::span<const float> before,
                    std::span<const float> after) {
    const std::size_t count = scene.columns().count();
    double sum = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const auto colour = static_cast<std::uint32_t>(i / count);
        sum += std::abs(double{after[i]} - double{before[i]}) *
               std::sqrt(double{scene.transport().energy(i % count, colour)});
    }
    return sum;
}

Rest rest_of(const std::shared_ptr<const served::Scene>& scene,
             relighting::Strategy strategy,
             const Lighting& first,
             const Lighting& wanted,
             const RelitImage& exact) {
    const double exact_norm = norm(exact);
    const engine::SelectionBudget budget{.columns = kColumns,
                                         .bytes = std::numeric_limits<std::uint64_t>::max()};
    engine::Session session(scene->workspace(), strategy);
    session.set_target(first);
    run_until_exact(session);
    session.set_target(wanted);
    engine::StepReport step = session.advance_incrementally(budget);
    Rest rest;
    RelitImage before = image_of(*scene, session);
    double error = distance(before, exact) / exact_norm;
    Lighting shown(session.approximation().begin(), session.approximation().end());
    const double all = sum_of(band_l1(*scene, wanted));
    double missing = sum_of(band_l1(*scene, wanted, shown));
    while (step.remaining > 0) {
        step = session.advance_incrementally(budget);
        const RelitImage after = image_of(*scene, session);
        const double next_error = distance(after, exact) / exact_norm;
        const double next_missing = sum_of(band_l1(*scene, wanted, session.approximation()));
        rest.lighting_rise = std::max(rest.lighting_rise, (next_missing - missing) / all);
        rest.images += 1;
        rest.rising += next_error > error ? 1 : 0;
        if (const double rise = next_error - error - kRounding; rise > 0) {
            rest.beyond_triangle = std::max(
                rest.beyond_triangle,
                rise * exact_norm / longest_step(*scene, shown, session.approximation()));
        }
        if (next_error / error > rest.image_rise) {
            rest.image_rise = next_error / error;
            rest.before = before;
            rest.after = after;
            rest.before_error = error;
            rest.after_error = next_error;
        }
        before = after;
        error = next_error;
        missing = next_missing;
        shown.assign(session.approximation().begin(), session.approximation().end());
    }
    rest.end_error = error;
    return rest;
}

Outcome provoke(Workbench& workbench) {
    const auto scene = workbench.baked("table");
    const std::vector<Lighting> lightings = turning_environment(
        lab::load_environment("studio", scene->face_resolution()), kJumpDegrees, 2);
    const Lighting& wanted = lightings.back();
    const RelitImage exact = exact_images(scene, std::span(&wanted, 1)).front();
    Outcome outcome;
    for (const relighting::Method method :
         {relighting::Method::nwa, relighting::Method::bi, relighting::Method::pbi,
          relighting::Method::guarded}) {
        for (const relighting::Priority priority :
             {relighting::Priority::area, relighting::Priority::benefit}) {
            const Rest rest = rest_of(scene, {.method = method, .priority = priority},
                                      lightings.front(), wanted, exact);
            const std::string name = fmt::format("{}-30-{}", relighting::name_from(method),
                                                 relighting::name_from(priority));
            outcome.findings.push_back({name + ": largest rise of ‖L−L̃‖₁ at rest",
                                        Sense::at_most, 0, rest.lighting_rise,
                                        "a column taken is exact from then on"});
            outcome.findings.push_back(
                {fmt::format("{}: of {:.0f} images at rest, farther than the one before", name,
                             rest.images),
                 Sense::reported, 0, rest.rising,
                 "columns are not orthogonal: a step home in the light can lead away in the "
                 "image"});
            outcome.findings.push_back({name + ": largest error, of that of the image before",
                                        Sense::reported, 0, rest.image_rise, "as above"});
            outcome.findings.push_back(
                {name + ": largest rise of ‖B−B̃‖, of Σ|ΔL|‖T‖ of the columns taken",
                 Sense::at_most, 1, rest.beyond_triangle, "triangle inequality"});
            outcome.findings.push_back({name + ": error with all columns taken", Sense::at_most,
                                        1e-5, rest.end_error,
                                        "README, before the full product"});
            if (priority == relighting::Priority::area && rest.rising > 0) {
                const float exposure = exposure_for(exact);
                outcome.tiles.push_back(
                    {rest.before, fmt::format("{}: error {:.4f}", name, rest.before_error),
                     exposure});
                outcome.tiles.push_back(
                    {rest.after, fmt::format("next image: error {:.4f}", rest.after_error),
                     exposure});
            }
            workbench.progress("slow_rest", 0.5);
        }
    }
    outcome.tiles.push_back({exact, "exact", exposure_for(exact)});
    return outcome;
}

}  // namespace

Failure slow_rest() {
    return {.name = "slow_rest",
            .what = "an image at rest moves away from where it goes",
            .scene = "table, n = 32; the CC0 map studio jumps by 110 degrees and rests",
            .provoke = provoke};
}

}  // namespace relume::stability
