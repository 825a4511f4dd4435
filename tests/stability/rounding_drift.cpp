// A light of 10⁵ goes on and off while the sky turns, edit upon edit, and nothing ever rests.
#include "server/engine/band_images.h"
#include "server/light/procedural_environment.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/support/dark_tenth_error.h"
#include "tests/support/tiny_transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace relume::stability {
namespace {

constexpr std::uint32_t kColumns = 30;
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
           const engine::Scene& scene,
           std::span<const float> sums,
           std::span<const float> lighting) {
    const auto exact = test::dense_product(scene.transport(), lighting);
    worst.dark_tenth =
        std::max(worst.dark_tenth, test::dark_tenth_error(scene.transport(), sums, exact));
    worst.l2 = std::max(worst.l2, test::relative_l2(sums, exact));
}

// The worst of some checks, each at the end of a period, long after the lamp went out.
Drift drift_of(Workbench& workbench,
               const std::shared_ptr<const engine::Scene>& scene,
               const LampScript& script,
               wire::Method method,
               std::size_t edits) {
    engine::Session session(scene, {.method = method, .priority = wire::Priority::benefit});
    const wire::Budget budget{.milliseconds = {}, .coefficients = kColumns, .target_error = 0};
    Drift worst;
    for (std::size_t edit = 0; edit < edits; ++edit) {
        session.set_lighting(script.at(edit));
        session.advance(budget);
        if ((edit + 1) % (edits / kChecks) == 0) {
            raise(worst, *scene, session.sums(), session.approximation());
            workbench.progress(fmt::format("rounding_drift, {}", wire::name_from(method)),
                               static_cast<double>(edit + 1) / static_cast<double>(edits));
        }
    }
    return worst;
}

// What floats do when left alone: every difference is added to the sums of the bands, and
// nothing is ever made anew.
struct Uncompensated {
    Drift drift;
    RelitImage image;
};
Uncompensated add_without_end(const engine::Scene& scene,
                              const LampScript& script,
                              std::size_t edits) {
    engine::BandImages images(scene);
    Lighting shown(script.at(0).size());
    std::vector<engine::ColumnChange> changes;
    for (std::size_t edit = 0; edit < edits; ++edit) {
        const Lighting& wanted = script.at(edit);
        Lighting difference(shown.size());
        std::transform(wanted.begin(), wanted.end(), shown.begin(), difference.begin(),
                       std::minus<>());
        changes.clear();
        for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
            const auto of_band = engine::changes_from_nothing(scene, difference, band);
            changes.insert(changes.end(), of_band.begin(), of_band.end());
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
        workbench.baked("table", {.width = 64, .height = 48, .face_resolution = 8});
    const LampScript script(scene->face_resolution());
    const std::size_t uncompensated_edits = workbench.choose<std::size_t>(2'000, 20'000);
    const Uncompensated plain = add_without_end(*scene, script, uncompensated_edits);
    Outcome outcome;
    outcome.findings.push_back(
        {fmt::format("float sums left alone, {} edits: error in the darkest tenth",
                     uncompensated_edits),
         Sense::at_least, 1e-4, plain.drift.dark_tenth, "the bound that the engine must keep"});
    for (const wire::Method method :
         {wire::Method::bi, wire::Method::pbi, wire::Method::guarded}) {
        // BI goes the whole way: it never resets of its own accord.
        const std::size_t edits = workbench.choose<std::size_t>(
            5'000, method == wire::Method::bi ? 1'000'000 : 100'000);
        const Drift drift = drift_of(workbench, scene, script, method, edits);
        outcome.findings.push_back({fmt::format("{}-30, {} edits: error in the darkest tenth",
                                                wire::name_from(method), edits),
                                    Sense::at_most, 1e-4, drift.dark_tenth,
                                    "rounding spreads evenly; the darkest tenth is not ten "
                                    "times darker than the whole"});
        outcome.findings.push_back({fmt::format("{}-30: relative L2", wire::name_from(method)),
                                    Sense::at_most, 1e-5, drift.l2,
                                    "the drift at which the engine makes a band anew"});
    }
    return outcome;
}

}  // namespace

Failure rounding_drift() {
    return {.name = "rounding_drift",
            .where = "7.4",
            .what = "what was bright leaves its rounding behind",
            .scene =
                "table, 64x48, n = 8; a lamp of radiance 1e5 is on for ten edits of every "
                "hundred, under an overcast sky that turns",
            .provoke = provoke};
}

}  // namespace relume::stability
