// Every image states its error: within 20 % of the true one for 95 % of images over all test
// sequences, and never off by 1.5×.
#include "protocol/light/procedural_environment.h"
#include "tests/lab/measures/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace relume::lab {
namespace {

std::shared_ptr<const served::Scene> test_scene() {
    return std::make_shared<const served::Scene>(
        transport::Transport::open(RELUME_TEST_SCENES "/table.relume"));
}

// Errors of rounding size are not a method's: floats know an image no better than this.
constexpr double kRounding = 1e-5;

struct Tally {
    std::size_t images = 0;
    std::size_t within_20_percent = 0;
    double worst = 1;

    void add(double stated, double truth) {
        const double ratio = stated / truth;
        ++images;
        within_20_percent += ratio >= 1 / 1.2 && ratio <= 1.2 ? 1 : 0;
        worst = std::max({worst, ratio, 1 / ratio});
    }
};

TEST(StatedError, HoldsOverAllSequencesAndMethods) {
    const auto scene = test_scene();
    const std::vector<Method> methods{
        method_from_text("nwa-100-area"),       method_from_text("bi-30-transport"),
        method_from_text("pbi-30-area"),        method_from_text("pbi-30-transport"),
        method_from_text("pbi-200-none"),       method_from_text("guarded-30-benefit"),
        method_from_text("guarded-1MB-benefit")};
    Tally all;
    const auto prefiltered = [&scene](const char* map) {
        return std::make_shared<const light::PrefilteredEnvironment>(
            std::make_shared<const light::EnvironmentMap>(light::procedural_environment(map)),
            scene->face_resolution());
    };
    // By turns: a sequence under one map tells as much as under both.
    const std::array maps{prefiltered("sky-noon"), prefiltered("studio-softboxes")};
    const auto overcast = prefiltered("sky-overcast");
    std::size_t turn = 0;
    for (const std::string& name : sequence_names()) {
        LightingSequence sequence = load_sequence(name);
        if (sequence.moves_camera()) {
            continue;  // the pixels of this scene are those of one camera
        }
        Tally tally;
        const Findings findings = run_experiment(
            {.scene = {.haar = scene, .sh_transport = {}},
             .sequence = std::move(sequence),
             .environments = {.environment = maps[turn++ % maps.size()], .blend = overcast},
             .methods = methods,
             .pictures = {}});
        for (const Record& record : findings.records) {
            if (record.error.l2 > kRounding) {
                tally.add(record.stated_error, record.error.l2);
                all.add(record.stated_error, record.error.l2);
            }
        }
        RecordProperty(name + " worst", std::to_string(tally.worst));
        EXPECT_LT(tally.worst, 1.5) << name;
    }
    const double part =
        static_cast<double>(all.within_20_percent) / static_cast<double>(all.images);
    std::printf("stated error: %zu images, %.2f %% within 20 %%, worst off by %.3f\n",
                all.images, 100 * part, all.worst);
    EXPECT_GE(part, 0.95);
}

}  // namespace
}  // namespace relume::lab
