// A light of 10⁵ goes on and off while the sky turns, edit upon edit, and nothing ever rests.
#include "protocol/light/procedural_environment.h"
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/sums/band_sums.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/support/dark_tenth_error.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>

namespace relume::stability {
namespace {

// The scene and the columns an edit are as small as they are so that a million edits end in two
// minutes.
constexpr std::uint32_t kColumns = 15;
// Of every hundred edits the lamp is on for ten.
constexpr std::size_t kPeriod = 100;
constexpr std::size_t kLampOn = 10;
constexpr std::size_t kTurns = 240;
constexpr std::size_t kChecks = 10;

// Lightings of a turning sky, without and with the lamp.
struct LampScript {
    std::vector<Lighting> off;
    std::vector<Lighting> on;

    explicit LampScript(std::uint32_t n) {
        light::LightRig rig;
        rig.environment = std::make_shared<const light::PrefilteredEnvironment>(
            std::make_shared<const light::EnvironmentMap>(
                light::procedural_environment("sky-overcast")),
            n);
        const light::AreaLight lamp{.direction = {0.4F, 1, 0.3F},
                                    .angular_radius_radians = 0.05F,
                                    .radiance = Imath::V3f(1e5F)};
        for (std::size_t turn = 0; turn < kTurns; ++turn) {
            rig.rotation.setAxisAngle(Imath::V3f(0.3F, 1, 0).normalized(),
                                      radians_from_degrees(1.5F * static_cast<float>(turn)));
            rig.lights.clear();
            off.push_back(lighting_from_rig(rig, n));
            rig.lights.push_back(lamp);
            on.push_back(lighting_from_rig(rig, n));
        }
    }

    [[nodiscard]] const Lighting& at(std::size_t edit) const {
        return (edit % kPeriod < kLampOn ? on : off)[edit % kTurns];
    }
};

struct Drift {
    double dark_tenth = 0;
    double l2 = 0;
};

void raise(Drift& worst,
           const served::Scene& scene,
           std::span<const float> sums,
           std::span<const float> lighting) {
    const auto exact = test::dense_product(scene.transport(), lighting);
    worst.dark_tenth =
        std::max(worst.dark_tenth, test::dark_tenth_error(scene.transport(), sums, exact));
    worst.l2 = std::max(worst.l2, test::relative_l2(sums, exact));
}

// The worst of some checks, each at the end of a period, long after the lamp went out.
Drift drift_of(const std::shared_ptr<const served::Scene>& scene,
               const LampScript& script,
               relighting::Method method,
               std::size_t edits,
               const std::function<void()>& check_is_done) {
    engine::Session session(scene->workspace(),
                            {.method = method, .priority = relighting::Priority::benefit});
    const relighting::Budget budget{
        .milliseconds = {}, .coefficients = kColumns, .target_error = 0};
    Drift worst;
    for (std::size_t edit = 0; edit < edits; ++edit) {
        session.set_target(script.at(edit));
        session.advance(budget);
        if ((edit + 1) % (edits / kChecks) == 0) {
            raise(worst, *scene, session.sums(), session.approximation());
            check_is_done();
        }
    }
    return worst;
}

struct DriftOfMethod {
    relighting::Method method;
    std::size_t edits = 0;
    Drift drift = {};
};

// Each method on a thread of its own: an edit of so small an image is over before others could
// help, and waking them for it takes as long as the edit.
void measure(Workbench& workbench,
             const std::shared_ptr<const served::Scene>& scene,
             const LampScript& script,
             std::span<DriftOfMethod> methods) {
    std::size_t all = 0;
    for (const DriftOfMethod& of : methods) {
        all += of.edits;
    }
    std::mutex counting;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, methods.size(), [&](std::size_t i) {
        DriftOfMethod& of = methods[i];
        tbb::task_arena(1).execute([&] {
            of.drift = drift_of(scene, script, of.method, of.edits, [&] {
                const std::lock_guard lock(counting);
                done += of.edits / kChecks;
                workbench.progress("rounding_drift",
                                   static_cast<double>(done) / static_cast<double>(all));
            });
        });
    });
}

// What floats do when left alone: every difference is added to the total, and nothing is ever
// made anew.
struct Uncompensated {
    Drift drift;
    RelitImage image;
};
Uncompensated add_without_end(const served::Scene& scene,
                              const LampScript& script,
                              std::size_t edits) {
    engine::BandSums images(scene.stored_operator());
    Lighting shown(script.at(0).size());
    std::vector<engine::ColumnChange> changes;
    for (std::size_t edit = 0; edit < edits; ++edit) {
        const Lighting& wanted = script.at(edit);
        changes.clear();
        const std::size_t count = scene.columns().count();
        for (const std::uint32_t j : scene.columns().by_band()) {
            changes.push_back({.column = j,
                               .from = {shown[j], shown[count + j], shown[2 * count + j]},
                               .to = {wanted[j], wanted[count + j], wanted[2 * count + j]}});
            if (changes.back().is_nothing()) {
                changes.pop_back();
            }
        }
        images.update(0, changes);
        shown = wanted;
    }
    Uncompensated result;
    raise(result.drift, scene, images.total(), shown);
    return result;
}

Outcome provoke(Workbench& workbench) {
    const auto scene =
        workbench.baked("table", {.width = 32, .height = 32, .face_resolution = 8});
    const LampScript script(scene->face_resolution());
    const std::size_t uncompensated_edits = workbench.choose<std::size_t>(2'000, 20'000);
    const Uncompensated plain = add_without_end(*scene, script, uncompensated_edits);
    Outcome outcome;
    outcome.findings.push_back(
        {fmt::format("float sums left alone, {} edits: error in the darkest tenth",
                     uncompensated_edits),
         Sense::at_least, 1e-4, plain.drift.dark_tenth, "the bound that the engine must keep"});
    // BI goes the whole way: it never resets of its own accord.
    std::array methods{
        DriftOfMethod{relighting::Method::bi, workbench.choose<std::size_t>(5'000, 1'000'000)},
        DriftOfMethod{relighting::Method::pbi, workbench.choose<std::size_t>(5'000, 100'000)},
        DriftOfMethod{relighting::Method::guarded,
                      workbench.choose<std::size_t>(5'000, 100'000)}};
    measure(workbench, scene, script, methods);
    for (const auto& [method, edits, drift] : methods) {
        outcome.findings.push_back({fmt::format("{}-{}, {} edits: error in the darkest tenth",
                                                relighting::name_from(method), kColumns, edits),
                                    Sense::at_most, 1e-4, drift.dark_tenth,
                                    "rounding spreads evenly; the darkest tenth is not ten "
                                    "times darker than the whole"});
        outcome.findings.push_back(
            {fmt::format("{}-{}: relative L2", relighting::name_from(method), kColumns),
             Sense::at_most, 1e-5, drift.l2,
             "the drift at which the engine makes a band anew"});
    }
    return outcome;
}

}  // namespace

Failure rounding_drift() {
    return {.name = "rounding_drift",
            .what = "what was bright leaves its rounding behind",
            .scene =
                "table, 32x32, n = 8; a lamp of radiance 1e5 is on for ten edits of every "
                "hundred, under an overcast sky that turns",
            .provoke = provoke};
}

}  // namespace relume::stability
