// How much of the memory's speed reaches the image: dense columns against plain reading.
#include "server/engine/sums/band_sums.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::bench {
namespace {

// Images of `terms` columns each that go through the transport from end to end, lighting every
// column, and once more, darkening them: a column comes back only after all others have passed
// the caches.
std::vector<ChangesOfImage> walk_through(const served::Scene& scene, std::size_t terms) {
    const std::size_t count = scene.columns().count();
    std::vector<ChangesOfImage> images;
    for (std::size_t first = 0; first + terms <= count; first += terms) {
        ChangesOfImage& image = images.emplace_back();
        for (std::size_t j = first; j < first + terms; ++j) {
            image.push_back({.column = static_cast<std::uint32_t>(j), .to = {1, 0.5F, 0.25F}});
        }
        const auto bands = scene.columns().bands();
        std::sort(image.begin(), image.end(), [&](const auto& a, const auto& b) {
            return std::pair(bands[a.column], a.column) < std::pair(bands[b.column], b.column);
        });
    }
    for (std::size_t i = 0, lit = images.size(); i < lit; ++i) {
        ChangesOfImage& image = images.emplace_back(images[i]);
        for (engine::ColumnChange& change : image) {
            std::swap(change.from, change.to);
        }
    }
    return images;
}

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.dense_scene();
    constexpr std::size_t kTerms = 300;
    const auto images =
        walk_through(*scene, std::min<std::size_t>(kTerms, scene->columns().count() / 2));
    const std::size_t rounds = workbench.quick() ? 3 : 5 * images.size();
    ReadBandwidth& reading = workbench.read_bandwidth();
    for (const int threads : Workbench::thread_counts()) {
        test::with_threads(threads, [&] {
            engine::BandSums relit(scene->stored_operator());
            const test::TimedVariant variants[] = {
                [&](std::size_t round) { relit.update(0, images[round % images.size()]); },
                [&](std::size_t round) {
                    reading.read(bytes_of(*scene, images[round % images.size()]));
                },
            };
            const auto seconds = test::seconds_in_turn(variants, rounds);
            // Both touched the same number of bytes.
            results.set(fmt::format("bandwidth_ratio_{}t", threads),
                        test::median_ratio(seconds[1], seconds[0]));
            const auto bytes = static_cast<double>(bytes_of(*scene, images.front()));
            results.measured("bandwidth")[fmt::format("{}t", threads)] = {
                {"columns_bytes_per_second", bytes / test::median(seconds[0])},
                {"read_bytes_per_second", bytes / test::median(seconds[1])},
                {"bytes_per_image", bytes}};
        });
    }
    if (Workbench::thread_counts().size() < 2) {
        results.omit("bandwidth_ratio_2t", "this machine has one core");
    }
}

}  // namespace

FigureGroup bandwidth_figures() {
    return {.figures = {{.key = "bandwidth_ratio_1t",
                         .meaning = "dense columns per second / read bandwidth, 1 thread",
                         .aim = Aim::at_least,
                         .target = 0.60},
                        {.key = "bandwidth_ratio_2t",
                         .meaning = "dense columns per second / read bandwidth, 2 threads",
                         .aim = Aim::at_least,
                         .target = 0.80}},
            .measure = measure};
}

}  // namespace relume::bench
