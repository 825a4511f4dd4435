// What rounding leaves behind when edits never rest.
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/workbench.h"
#include "tests/support/dark_tenth_error.h"
#include "tests/support/tiny_transport.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>

namespace relume::bench {
namespace {

constexpr float kLampRadiance = 1e5F;
// Of every hundred edits the lamp is on for ten.
constexpr std::size_t kPeriod = 100;
constexpr std::size_t kLampOn = 10;
constexpr std::size_t kTurns = 240;  // of the environment, 1.5 degrees each
constexpr std::size_t kChecks = 10;
constexpr std::uint32_t kTerms = 15;

std::vector<float> lamp_lighting(std::uint32_t face_resolution) {
    light::LightRig rig;
    rig.lights = {{.direction = Imath::V3f(0.4F, 1, 0.3F).normalized(),
                   .angular_radius_radians = 0.05F,
                   .radiance = Imath::V3f(kLampRadiance)}};
    light::LightCubemap cubemap;
    light::evaluate(rig, face_resolution, cubemap);
    std::vector<float> coefficients;
    const auto projection =
        basis::CubemapProjection::onto(basis::CubemapBasis::haar(face_resolution));
    light::lighting_coefficients(cubemap, *projection, coefficients);
    return coefficients;
}

// The worst of all checks. Each stands at the end of a period, long after the lamp went out,
// and compares the image shown with the dense product of the lighting that it shows.
double worst_drift(const std::shared_ptr<const served::Scene>& scene,
                   relighting::Strategy strategy,
                   std::size_t edits) {
    const LightDrag drag(scene->face_resolution());
    const std::vector<float> lamp = lamp_lighting(scene->face_resolution());
    std::vector<std::vector<float>> off;
    std::vector<std::vector<float>> on;
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
        off.push_back(drag.lighting(turn));
        on.push_back(off.back());
        std::transform(lamp.begin(), lamp.end(), on.back().begin(), on.back().begin(),
                       std::plus<>());
    }
    const relighting::Budget budget{
        .milliseconds = {}, .coefficients = kTerms, .target_error = 0};
    engine::Session session(scene->workspace(), strategy);
    double worst = 0;
    for (std::size_t edit = 0; edit < edits; ++edit) {
        const auto& lighting = edit % kPeriod < kLampOn ? on : off;
        session.set_target(lighting[edit % kTurns]);
        session.advance(budget);
        if ((edit + 1) % (edits / kChecks) == 0) {
            const auto exact = test::dense_product(scene->transport(), session.approximation());
            worst = std::max(worst,
                             test::dark_tenth_error(scene->transport(), session.sums(), exact));
        }
    }
    return worst;
}

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.drift_scene();
    const std::size_t edits = workbench.quick() ? 10 * kPeriod : 1'000'000;
    nlohmann::json& measured = results.measured("drift");
    measured["edits"] = edits;
    // The default, and the method that never resets of its own accord.
    constexpr std::array kStrategies{relighting::Strategy{},
                                     relighting::Strategy{.method = relighting::Method::bi}};
    std::array<double, kStrategies.size()> drifts{};
    // Each on a thread of its own: an edit of so small an image is over before others could
    // help.
    tbb::parallel_for(std::size_t{0}, kStrategies.size(), [&](std::size_t i) {
        tbb::task_arena(1).execute(
            [&] { drifts[i] = worst_drift(scene, kStrategies[i], edits); });
    });
    for (std::size_t i = 0; i < kStrategies.size(); ++i) {
        measured[std::string(relighting::name_from(kStrategies[i].method))] = drifts[i];
    }
    const double worst = *std::max_element(drifts.begin(), drifts.end());
    results.set("drift_dark_tenth", worst);
}

}  // namespace

FigureGroup drift_figures() {
    return {.figures = {{.key = "drift_dark_tenth",
                         .meaning = "rounding after 10^6 edits, relative, darkest tenth",
                         .aim = Aim::at_most,
                         .target = 1e-4}},
            .measure = measure};
}

}  // namespace relume::bench
