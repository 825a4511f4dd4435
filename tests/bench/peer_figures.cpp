// The engine beside Eigen and [Ng03]: same transport, same coefficients, same threads, by
// turns.
#include "server/engine/band_images.h"
#include "tests/bench/eigen_product.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/light_drag.h"
#include "tests/bench/ng03_product.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace relume::bench {
namespace {

// Both add in float, in another order than the engine.
constexpr double kLargestDifference = 1e-5;
constexpr std::size_t kImages = 24;
constexpr std::size_t kTerms[] = {30, 100, 300};

double relative_l2(std::span<const float> image, std::span<const float> reference) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double d = double{image[i]} - double{reference[i]};
        difference += d * d;
        norm += double{reference[i]} * double{reference[i]};
    }
    return std::sqrt(difference / norm);
}

// Both hold the columns that a drag touches, and no others.
struct Peers {
    EigenColumns eigen;
    Ng03Columns ng03;
};

// The images of a drag, made by each; throws when they are not the same.
void check_images(const engine::Scene& scene,
                  const Peers& peers,
                  std::span<const ChangesOfImage> images,
                  nlohmann::json& measured) {
    engine::BandImages ours(scene);
    Ng03Product ng03(peers.ng03);
    std::vector<std::unique_ptr<EigenProduct>> eigen;
    for (const EigenLayout layout : kEigenLayouts) {
        eigen.push_back(std::make_unique<EigenProduct>(peers.eigen, layout));
    }
    for (const ChangesOfImage& image : images) {
        ours.update(0, image);
        ng03.add(image);
        for (const auto& product : eigen) {
            product->add(image);
        }
    }
    const auto check = [&](const std::string& name, const std::vector<float>& sums) {
        const double difference = relative_l2(sums, ours.total());
        measured["image_difference"][name] = difference;
        if (!(difference <= kLargestDifference)) {
            throw std::runtime_error(
                fmt::format("the image of {} differs from ours by {:.3g}, expected at most {}",
                            name, difference, kLargestDifference));
        }
    };
    check("ng03", ng03.sums());
    for (std::size_t i = 0; i < eigen.size(); ++i) {
        check(fmt::format("eigen {}", name_from(kEigenLayouts[i])), eigen[i]->sums());
    }
}

// Of the columns of the drag: what they are stored as explains much of the times.
nlohmann::json bytes_by_encoding(const engine::Scene& scene,
                                 std::span<const std::uint32_t> columns) {
    std::array<std::uint64_t, transport::kCellTagCount> bytes{};
    for (const auto& shard : scene.transport().shards()) {
        for (const std::uint32_t j : columns) {
            for (std::uint32_t k = 0; k < scene.transport().channel_count(); ++k) {
                const transport::SegmentView segment = shard.segment(j, k);
                const std::uint8_t* cell = segment.cells;
                for (std::uint32_t b = 0; !segment.empty() && b < shard.block_count(); ++b) {
                    const std::size_t size = transport::cell_bytes(segment.tag(b), cell);
                    bytes[static_cast<std::size_t>(segment.tag(b))] += size;
                    cell += size;
                }
            }
        }
    }
    nlohmann::json by_name;
    for (std::size_t tag = 0; tag < bytes.size(); ++tag) {
        by_name[transport::kCellTagNames[tag]] = bytes[tag];
    }
    return by_name;
}

// Eigen's fastest layout here, tried before anything counts.
EigenLayout fastest_layout(const Peers& peers, std::span<const ChangesOfImage> images) {
    std::vector<std::unique_ptr<EigenProduct>> products;
    std::vector<test::TimedVariant> variants;
    for (const EigenLayout layout : kEigenLayouts) {
        products.push_back(std::make_unique<EigenProduct>(peers.eigen, layout));
        variants.emplace_back([product = products.back().get(), images](std::size_t round) {
            product->add(images[round % images.size()]);
        });
    }
    const auto seconds = test::seconds_in_turn(variants, images.size());
    std::size_t best = 0;
    for (std::size_t i = 1; i < seconds.size(); ++i) {
        best = test::median(seconds[i]) < test::median(seconds[best]) ? i : best;
    }
    return kEigenLayouts[best];
}

struct Speedups {
    double eigen = std::numeric_limits<double>::infinity();
    double ng03 = std::numeric_limits<double>::infinity();
};

Speedups time_peers(const engine::Scene& scene,
                    const Peers& peers,
                    std::span<const ChangesOfImage> images,
                    std::size_t rounds,
                    nlohmann::json& measured) {
    const EigenLayout layout = fastest_layout(peers, images);
    engine::BandImages ours(scene);
    EigenProduct eigen(peers.eigen, layout);
    Ng03Product ng03(peers.ng03);
    const test::TimedVariant variants[] = {
        [&](std::size_t round) { ours.update(0, images[round % images.size()]); },
        [&](std::size_t round) { eigen.add(images[round % images.size()]); },
        [&](std::size_t round) { ng03.add(images[round % images.size()]); },
    };
    const auto seconds = test::seconds_in_turn(variants, rounds);
    std::uint64_t bytes = 0;
    for (const ChangesOfImage& image : images) {
        bytes += bytes_of(scene, image);
    }
    measured["ours_ms"] = 1e3 * test::median(seconds[0]);
    measured["eigen_ms"] = 1e3 * test::median(seconds[1]);
    measured["ng03_ms"] = 1e3 * test::median(seconds[2]);
    measured["eigen_layout"] = name_from(layout);
    measured["our_bytes_per_image"] = bytes / images.size();
    const Speedups speedups{.eigen = test::median_ratio(seconds[1], seconds[0]),
                            .ng03 = test::median_ratio(seconds[2], seconds[0])};
    measured["speedup_over_eigen"] = speedups.eigen;
    measured["speedup_over_ng03"] = speedups.ng03;
    return speedups;
}

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.scene();
    for (const std::size_t terms : kTerms) {
        const auto images = drag_changes(*scene, terms, kImages);
        const auto columns = columns_of(images);
        nlohmann::json& measured = results.measured("peers")[std::to_string(terms)];
        const Peers peers{.eigen = {*scene, columns}, .ng03 = {*scene, columns}};
        measured["columns"] = columns.size();
        measured["bytes_by_encoding"] = bytes_by_encoding(*scene, columns);
        measured["nonzeros"] = peers.eigen.nonzeros();
        measured["ng03_entries"] = peers.ng03.entries();
        measured["ng03_extra_entries"] = peers.ng03.extra_entries();
        check_images(*scene, peers, images, measured);
        const std::size_t rounds = workbench.quick() ? 3 : 3 * kImages;
        Speedups least;
        for (const int threads : Workbench::thread_counts()) {
            test::with_threads(threads, [&] {
                const Speedups speedups = time_peers(*scene, peers, images, rounds,
                                                     measured[fmt::format("{}t", threads)]);
                least.eigen = std::min(least.eigen, speedups.eigen);
                least.ng03 = std::min(least.ng03, speedups.ng03);
            });
        }
        results.set(fmt::format("speedup_over_eigen_{}", terms), least.eigen);
        results.set(fmt::format("speedup_over_ng03_{}", terms), least.ng03);
    }
}

}  // namespace

FigureGroup peer_figures() {
    FigureGroup group{.figures = {}, .measure = measure};
    for (const std::size_t terms : kTerms) {
        group.figures.push_back(
            {.key = fmt::format("speedup_over_eigen_{}", terms),
             .meaning =
                 fmt::format("Eigen's time / ours, {} terms, worse of 1 and 2 threads", terms),
             .aim = Aim::at_least,
             .target = 6});
    }
    for (const std::size_t terms : kTerms) {
        group.figures.push_back(
            {.key = fmt::format("speedup_over_ng03_{}", terms),
             .meaning =
                 fmt::format("[Ng03]'s time / ours, {} terms, worse of 1 and 2 threads", terms),
             .aim = Aim::at_least,
             .target = 5});
    }
    return group;
}

}  // namespace relume::bench
