// Lighting as large and as small as floats go.
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "tests/stability/provocations.h"
#include "tests/support/random_lighting.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace relume::stability {
namespace {

constexpr relighting::Method kMethods[] = {relighting::Method::nwa, relighting::Method::bi,
                                           relighting::Method::pbi,
                                           relighting::Method::guarded};

// Scaled so that the largest coefficient is of this magnitude.
Lighting scaled_lighting(std::uint32_t n, std::uint64_t seed, float largest) {
    Lighting lighting = test::random_lighting(n, seed);
    double found = 0;
    for (const float value : lighting) {
        found = std::max(found, std::abs(double{value}));
    }
    for (float& value : lighting) {
        value = static_cast<float>(double{value} / found * double{largest});
    }
    return lighting;
}

struct Extremes {
    double not_finite = 0;  // values of images, and stated errors
    double error = 0;       // largest, of exact images, against the dense product
    double not_exact = 0;   // sessions that did not come to rest
};

// Under every method: from one lighting to its opposite, so that differences are twice as
// large, with few columns an image, and then to rest.
void swing(const std::shared_ptr<const served::Scene>& scene,
           float largest,
           std::uint64_t seed,
           Extremes& extremes) {
    const std::uint32_t n = scene->face_resolution();
    const auto watch = [&](const engine::Session& session, const engine::StepReport& report) {
        extremes.not_finite += std::isfinite(report.stated_error) ? 0 : 1;
        for (const float value : image_of(*scene, session).rgb) {
            extremes.not_finite += std::isfinite(value) ? 0 : 1;
        }
    };
    for (const relighting::Method method : kMethods) {
        engine::Session session(scene->workspace(),
                                {.method = method, .priority = relighting::Priority::benefit});
        const relighting::Budget few{.milliseconds = {}, .coefficients = 40, .target_error = 0};
        Lighting lighting;
        for (int turn = 0; turn < 4; ++turn) {
            lighting = scaled_lighting(n, seed + static_cast<std::uint64_t>(turn / 2), largest);
            for (float& value : lighting) {
                value = turn % 2 == 0 ? value : -value;
            }
            session.set_target(lighting);
            for (int step = 0; step < 3; ++step) {
                watch(session, session.advance(few));
            }
        }
        for (std::size_t i = 0; i < scene->columns().count() && !session.exact(); ++i) {
            watch(session, session.advance(few));
        }
        extremes.not_exact += session.exact() ? 0 : 1;
        extremes.error =
            std::max(extremes.error,
                     test::relative_l2(session.sums(),
                                       test::dense_product(scene->transport(), lighting)));
    }
}

bool is_refused(const std::shared_ptr<const served::Scene>& scene, float largest) {
    engine::Session session(scene->workspace(), {});
    try {
        session.set_target(scaled_lighting(scene->face_resolution(), 1, largest));
    } catch (const std::invalid_argument&) {
        return true;
    }
    return false;
}

Outcome provoke(Workbench& workbench) {
    const std::uint64_t seeds = workbench.choose<std::uint64_t>(2, 20);
    const auto swing_all = [&](float largest) {
        Extremes extremes;
        for (const std::uint32_t channels : {1U, 3U}) {
            for (std::uint64_t seed = 0; seed < seeds; ++seed) {
                swing(workbench.tiny(channels), largest, workbench.seed() + 10 * seed,
                      extremes);
            }
        }
        return extremes;
    };
    Outcome outcome;
    for (const float largest : {1e30F, 1e22F, 1e10F, 1e-20F, 1e-30F}) {
        const Extremes extremes = swing_all(largest);
        outcome.findings.push_back(
            {fmt::format("lighting up to {:.0e}: values and stated errors not finite", largest),
             Sense::at_most, 0, extremes.not_finite,
             "a sum is below Σ|L||T|, far from the largest float"});
        outcome.findings.push_back(
            {fmt::format("{:.0e}: sessions that never became exact", largest), Sense::at_most,
             0, extremes.not_exact,
             "a column that differs is taken, however little it weighs"});
        // Further down products are denormal and have no relative precision to keep.
        const bool is_precise = largest >= 1e-20F;
        outcome.findings.push_back(
            {fmt::format("{:.0e}: exact image off the dense product, relative L2", largest),
             is_precise ? Sense::at_most : Sense::reported, 1e-5, extremes.error,
             is_precise ? "protocol/README.md: what exact means" : "products are denormal"});
        workbench.progress("extreme_lighting", 0.5);
    }
    outcome.findings.push_back({"lighting of 3e38 accepted", Sense::at_most, 0,
                                is_refused(workbench.tiny(1), 3e38F) ? 0.0 : 1.0,
                                "its difference from its opposite is no float any more"});
    return outcome;
}

}  // namespace

Failure extreme_lighting() {
    return {.name = "extreme_lighting",
            .what = "sums overflow to infinity and NaN",
            .scene =
                "random transport, 40x24, n = 8; lighting of any size to its opposite and "
                "back, every method",
            .provoke = provoke};
}

}  // namespace relume::stability
