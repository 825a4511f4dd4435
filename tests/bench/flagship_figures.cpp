// The paper's regime: so many pixels and colours that the whole transport does not fit into an
// image's time.
#include "protocol/relighting/budget.h"
#include "protocol/base/timing/stopwatch.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/image_pipeline.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <algorithm>
#include <cmath>

namespace relume::bench {
namespace {

constexpr const char* kKeys[] = {"flagship_images_per_s", "flagship_ms_p99",
                                 "flagship_ms_to_exact"};

constexpr std::size_t kWarmUp = 5;

void measure(Workbench& workbench, Results& results) {
    if (!workbench.options().flagship) {
        for (const char* key : kKeys) {
            results.omit(key, "measured with --flagship");
        }
        return;
    }
    const std::size_t images = workbench.quick() ? 5 : 200;
    const auto scene = workbench.flagship_scene();
    const relighting::Budget budget;
    test::with_threads(Workbench::thread_counts().back(), [&] {
        ImagePipeline pipeline(scene);
        std::vector<double> latencies_ms;
        timing::Stopwatch drag;
        // The first images warm up: they are written to memory for the first time.
        for (std::size_t image = 0; image < kWarmUp + images; ++image) {
            if (image == kWarmUp) {
                latencies_ms.clear();
                drag = timing::Stopwatch();
            }
            const timing::Stopwatch stopwatch;
            pipeline.turn_light(image);
            pipeline.advance(budget);
            pipeline.begin_encoding();
            // The client waits for this image before it sees it: nothing is overlapped.
            pipeline.finish_encoding();
            latencies_ms.push_back(1e3 * stopwatch.seconds());
        }
        results.set(kKeys[0], static_cast<double>(images) / drag.seconds());
        std::sort(latencies_ms.begin(), latencies_ms.end());
        const auto rank =
            static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(images)));
        results.set(kKeys[1], latencies_ms[rank - 1]);
        const timing::Stopwatch resting;
        while (!pipeline.exact()) {
            pipeline.advance(budget);
        }
        results.set(kKeys[2], 1e3 * resting.seconds());
        results.measured("flagship") = {{"transport_bytes", scene->transport().total_bytes()},
                                        {"strip_bytes", scene->stored_operator().strips().bytes()},
                                        {"ms_p50", test::median(latencies_ms)},
                                        {"ms_max", latencies_ms.back()},
                                        {"images", images}};
    });
}

}  // namespace

FigureGroup flagship_figures() {
    return {.figures = {{.key = kKeys[0],
                         .meaning = "1920x1080 in colour: images/s dragging",
                         .aim = Aim::at_least,
                         .target = 20},
                        {.key = kKeys[1],
                         .meaning = "1920x1080 in colour: edit to JPEG, ms, p99",
                         .aim = Aim::at_most,
                         .target = 80},
                        {.key = kKeys[2],
                         .meaning = "1920x1080 in colour: from rest to exact, ms",
                         .aim = Aim::at_most,
                         .target = 1500}},
            .measure = measure};
}

}  // namespace relume::bench
