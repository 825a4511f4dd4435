// Dragging without approximation: every image is the exact one.
#include "protocol/relighting/budget.h"
#include "protocol/base/timing/stopwatch.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/image_pipeline.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

namespace relume::bench {
namespace {

void measure(Workbench& workbench, Results& results) {
    // Time enough for all of it, whatever the engine makes of that.
    const relighting::Budget budget{
        .milliseconds = 1000, .coefficients = {}, .target_error = 0};
    const std::size_t images = workbench.quick() ? 3 : 100;
    test::with_threads(Workbench::thread_counts().back(), [&] {
        ImagePipeline pipeline(workbench.scene());
        std::size_t steps = 0;
        std::size_t bytes = 0;
        std::uint64_t bytes_touched = 0;
        double seconds = 0;
        timing::Stopwatch stopwatch;
        // The first image warms up.
        for (std::size_t image = 0; image <= images; ++image) {
            if (image == 1) {
                stopwatch = timing::Stopwatch();
                steps = 0;
                bytes_touched = 0;
            }
            pipeline.turn_light(image);
            while (!pipeline.exact()) {
                bytes_touched += pipeline.advance(budget).bytes_touched;
                ++steps;
            }
            pipeline.begin_encoding();
        }
        bytes = pipeline.finish_encoding();
        seconds = stopwatch.seconds();
        const auto count = static_cast<double>(images);
        results.set("exact_images_per_s_512", count / seconds);
        results.measured("exact_images") = {
            {"images", images},
            {"steps_per_image", static_cast<double>(steps) / count},
            {"bytes_touched_per_image", static_cast<double>(bytes_touched) / count},
            {"jpeg_bytes", bytes}};
    });
}

}  // namespace

FigureGroup exact_image_figures() {
    return {.figures = {{.key = "exact_images_per_s_512",
                         .meaning = "images/s, each exact, light to JPEG, 2 threads",
                         .aim = Aim::at_least,
                         .target = 20}},
            .measure = measure};
}

}  // namespace relume::bench
