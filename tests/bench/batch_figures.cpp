// Sixteen sessions of one scene in one sweep against each by itself.
#include "protocol/relighting/budget.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace relume::bench {
namespace {

constexpr std::size_t kSessions = 16;
// Sixteen artists turn the same sky, each from where the others have not been.
constexpr std::size_t kImagesApart = 15;
constexpr std::uint32_t kTerms = 30;
const relighting::Budget kDragging{
    .milliseconds = {}, .coefficients = kTerms, .target_error = 0};

class Artists {
  public:
    explicit Artists(const std::shared_ptr<const served::Scene>& scene)
        : drag_(scene->face_resolution()) {
        for (std::size_t i = 0; i < kSessions; ++i) {
            sessions_.push_back(
                std::make_unique<engine::Session>(scene->workspace(), relighting::Strategy{}));
        }
    }

    // Everyone's light turns by so many images; not timed.
    void turn_lights(std::size_t images) {
        image_ += images;
        lights_.clear();
        for (std::size_t i = 0; i < kSessions; ++i) {
            lights_.push_back(drag_.lighting(image_ + kImagesApart * i));
        }
    }

    void set_lights() {
        for (std::size_t i = 0; i < kSessions; ++i) {
            sessions_[i]->set_target(lights_[i]);
        }
    }

    void step_alone(const relighting::Budget& budget) {
        for (const auto& session : sessions_) {
            session->advance(budget);
        }
    }

    void step_together(const relighting::Budget& budget) {
        std::vector<engine::SessionStep> turns;
        for (const auto& session : sessions_) {
            if (!session->at_rest(budget)) {
                turns.push_back({.session = session.get(), .budget = budget, .report = {}});
            }
        }
        engine::Session::advance_together(turns);
    }

    [[nodiscard]] bool exact() const {
        return std::all_of(sessions_.begin(), sessions_.end(),
                           [](const auto& session) { return session->exact(); });
    }

    void converge_alone(const relighting::Budget& budget) {
        for (const auto& session : sessions_) {
            while (!session->exact()) {
                session->advance(budget);
            }
        }
    }

    void converge_together(const relighting::Budget& budget) {
        while (!exact()) {
            step_together(budget);
        }
    }

  private:
    LightDrag drag_;
    std::vector<std::unique_ptr<engine::Session>> sessions_;
    std::vector<std::vector<float>> lights_;
    std::size_t image_ = 0;
};

struct Gain {
    std::vector<double> alone;
    std::vector<double> together;

    [[nodiscard]] double ratio() const { return test::median_ratio(alone, together); }
    [[nodiscard]] nlohmann::json milliseconds() const {
        return {{"alone_ms", 1e3 * test::median(alone)},
                {"together_ms", 1e3 * test::median(together)}};
    }
};

template <typename Work>
double timed(const Work& work) {
    const timing::Stopwatch stopwatch;
    work();
    return stopwatch.seconds();
}

// A new light each, thirty terms an image.
Gain drag(Artists& alone, Artists& together, std::size_t rounds) {
    Gain gain;
    for (std::size_t round = 0; round <= rounds; ++round) {
        for (Artists* artists : {&alone, &together}) {
            artists->turn_lights(1);
            artists->set_lights();
        }
        const double seconds[] = {timed([&] { alone.step_alone(kDragging); }),
                                  timed([&] { together.step_together(kDragging); })};
        if (round > 0) {  // the first warms up
            gain.alone.push_back(seconds[0]);
            gain.together.push_back(seconds[1]);
        }
    }
    return gain;
}

// Every light has jumped and rests; until all images are exact.
Gain rest(Artists& alone, Artists& together, std::size_t rounds) {
    constexpr std::size_t kJump = 7;
    Gain gain;
    for (std::size_t round = 0; round <= rounds; ++round) {
        for (Artists* artists : {&alone, &together}) {
            artists->turn_lights(kJump);
            artists->set_lights();
            // The image of the drag, so that both converge from there.
            artists->step_alone(kDragging);
        }
        const relighting::Budget budget;
        const double seconds[] = {timed([&] { alone.converge_alone(budget); }),
                                  timed([&] { together.converge_together(budget); })};
        if (round > 0) {
            gain.alone.push_back(seconds[0]);
            gain.together.push_back(seconds[1]);
        }
    }
    return gain;
}

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.scene();
    Artists alone(scene);
    Artists together(scene);
    test::with_threads(Workbench::thread_counts().back(), [&] {
        const Gain resting = rest(alone, together, workbench.quick() ? 1 : 3);
        const Gain dragging = drag(alone, together, workbench.quick() ? 3 : 30);
        results.set("batch_gain_resting", resting.ratio());
        results.set("batch_gain_dragging", dragging.ratio());
        results.measured("batch") = {{"sessions", kSessions},
                                     {"resting", resting.milliseconds()},
                                     {"dragging", dragging.milliseconds()}};
    });
}

}  // namespace

FigureGroup batch_figures() {
    return {.figures = {{.key = "batch_gain_resting",
                         .meaning = "16 sessions at rest to exact, alone / batched, 2 threads",
                         .aim = Aim::at_least,
                         .target = 3},
                        {.key = "batch_gain_dragging",
                         .meaning = "16 sessions dragging, 30 terms, alone / batched",
                         .aim = Aim::reported}},
            .measure = measure};
}

}  // namespace relume::bench
