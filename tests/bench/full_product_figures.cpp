// The whole product T·L against reading the transport once.
#include "server/engine/sums/full_product.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

namespace relume::bench {
namespace {

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.scene();
    const int threads = Workbench::thread_counts().back();
    const std::uint64_t bytes = scene->transport().total_bytes();
    const std::uint64_t whole = scene->stored_operator().strips().bytes();
    const std::vector<float> lighting = LightDrag(scene->face_resolution()).lighting(0);
    ReadBandwidth& reading = workbench.read_bandwidth();
    test::with_threads(threads, [&] {
        engine::FullProduct product(scene->stored_operator(), scene->workspace()->spare_sums());
        const test::TimedVariant variants[] = {
            [&](std::size_t /*round*/) {
                product.start(lighting);
                while (product.running()) {
                    product.advance(whole);
                }
            },
            [&](std::size_t /*round*/) { reading.read(bytes); },
        };
        const auto seconds = test::seconds_in_turn(variants, workbench.quick() ? 3 : 25);
        results.set("full_product_ratio", test::median_ratio(seconds[0], seconds[1]));
        results.measured("full_product") = {{"threads", threads},
                                            {"product_ms", 1e3 * test::median(seconds[0])},
                                            {"read_ms", 1e3 * test::median(seconds[1])},
                                            {"bytes", bytes},
                                            {"bytes_of_strips", whole}};
    });
}

}  // namespace

FigureGroup full_product_figures() {
    return {.figures = {{.key = "full_product_ratio",
                         .meaning = "T L, every coefficient / reading the transport, 2 threads",
                         .aim = Aim::at_most,
                         .target = 1.3}},
            .measure = measure};
}

}  // namespace relume::bench
