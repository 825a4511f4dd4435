// The engine beside Eigen and [Ng03]: same transport, same coefficients, same threads, by
// turns. They hold the transport by pixel, and then in the basis of our own cells.
#include "server/engine/sums/band_sums.h"
#include "tests/bench/figure_groups.h"
#include "tests/bench/peers.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace relume::bench {
namespace {

// All add in float, in different orders.
constexpr double kRoundingDifference = 1e-5;
// What the peers' 8 bits may cost of the image by pixel. They were seen to cost 0.002 of it on
// `mesh100k` and 0.023 on a small `table`, whose highlights stretch the range of a column:
// twice that, and the times would be of images that nobody would take for each other. That
// nothing but the 8 bits differs is checked with finer levels, to kRoundingDifference.
constexpr double kQuantisationDifference = 0.05;
constexpr std::size_t kImages = 24;
constexpr std::size_t kTerms[] = {30, 100, 300};

// Of the columns of the drag: what they are stored as explains much of the times.
nlohmann::json bytes_by_encoding(const served::Scene& scene,
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

// What the engine reads for the drag.
nlohmann::json our_columns(const served::Scene& scene, std::span<const ChangesOfImage> images) {
    const auto columns = columns_of(images);
    std::uint64_t bytes = 0;
    for (const ChangesOfImage& image : images) {
        bytes += bytes_of(scene, image);
    }
    return {{"columns", columns.size()},
            {"bytes_per_image", bytes / images.size()},
            {"bytes_by_encoding", bytes_by_encoding(scene, columns)}};
}

// By pixel, so finely rounded that nothing but floating point is left to differ: the first
// image alone, for such columns are large.
nlohmann::json differences_of_fine_pixels(const served::Scene& scene,
                                          std::span<const ChangesOfImage> images) {
    constexpr float kFineLevels = 1 << 22;
    const auto first = images.first(1);
    return checked_differences(Peers(scene, first, PeerBasis::pixels, kFineLevels), first,
                               kRoundingDifference);
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

// What the engine does for an image that is comparable to theirs: where they end with pixels,
// it turns its sums into pixels too, and applies the tint, which they do not.
class OurImage {
  public:
    OurImage(const served::Scene& scene, PeerBasis basis)
        : scene_(&scene), sums_(scene.stored_operator()) {
        if (basis == PeerBasis::pixels) {
            const transport::TileGrid& image = scene.image();
            pixels_.resize(std::size_t{transport::kColours} * image.width * image.height);
        }
    }

    void add(std::span<const engine::ColumnChange> changes) {
        sums_.update(0, changes);
        if (!pixels_.empty()) {
            scene_->write_image(sums_.total(), pixels_);
        }
    }

  private:
    const served::Scene* scene_;
    engine::BandSums sums_;
    std::vector<float> pixels_;  // row by row, RGB; empty where sums are compared
};

Speedups time_peers(const Peers& peers,
                    std::span<const ChangesOfImage> images,
                    std::size_t rounds,
                    nlohmann::json& measured) {
    const EigenLayout layout = fastest_layout(peers, images);
    OurImage ours(peers.columns.scene(), peers.columns.basis());
    EigenProduct eigen(peers.eigen, layout);
    Ng03Product ng03(peers.ng03);
    const test::TimedVariant variants[] = {
        [&](std::size_t round) { ours.add(images[round % images.size()]); },
        [&](std::size_t round) { eigen.add(images[round % images.size()]); },
        [&](std::size_t round) { ng03.add(images[round % images.size()]); },
    };
    const auto seconds = test::seconds_in_turn(variants, rounds);
    measured["ours_ms"] = 1e3 * test::median(seconds[0]);
    measured["eigen_ms"] = 1e3 * test::median(seconds[1]);
    measured["ng03_ms"] = 1e3 * test::median(seconds[2]);
    measured["eigen_layout"] = name_from(layout);
    const Speedups speedups{.eigen = test::median_ratio(seconds[1], seconds[0]),
                            .ng03 = test::median_ratio(seconds[2], seconds[0])};
    measured["speedup_over_eigen"] = speedups.eigen;
    measured["speedup_over_ng03"] = speedups.ng03;
    return speedups;
}

// The worse of one thread and two.
Speedups compare(const served::Scene& scene,
                 std::span<const ChangesOfImage> images,
                 PeerBasis basis,
                 std::size_t rounds,
                 nlohmann::json& measured) {
    const Peers peers(scene, images, basis);
    measured = to_json(peers);
    measured["image_difference"] = checked_differences(
        peers, images,
        basis == PeerBasis::ours ? kRoundingDifference : kQuantisationDifference);
    Speedups least;
    for (const int threads : Workbench::thread_counts()) {
        test::with_threads(threads, [&] {
            const Speedups speedups =
                time_peers(peers, images, rounds, measured[fmt::format("{}t", threads)]);
            least.eigen = std::min(least.eigen, speedups.eigen);
            least.ng03 = std::min(least.ng03, speedups.ng03);
        });
    }
    return least;
}

std::string key_of(std::string_view peer, std::size_t terms, PeerBasis basis) {
    return fmt::format("speedup_over_{}_{}{}", peer, terms,
                       basis == PeerBasis::ours ? "_in_our_basis" : "");
}

void measure(Workbench& workbench, Results& results) {
    const auto scene = workbench.scene();
    const std::size_t rounds = workbench.quick() ? 3 : 3 * kImages;
    for (const std::size_t terms : kTerms) {
        const auto images = drag_changes(*scene, terms, kImages);
        nlohmann::json& measured = results.measured("peers")[std::to_string(terms)];
        measured["ours"] = our_columns(*scene, images);
        measured["fine_pixel_difference"] = differences_of_fine_pixels(*scene, images);
        for (const PeerBasis basis : kPeerBases) {
            const Speedups speedups =
                compare(*scene, images, basis, rounds, measured[std::string(name_from(basis))]);
            results.set(key_of("eigen", terms, basis), speedups.eigen);
            results.set(key_of("ng03", terms, basis), speedups.ng03);
        }
    }
}

void append_figures(std::string_view peer,
                    std::string_view name,
                    double target,
                    PeerBasis basis,
                    std::vector<Figure>& figures) {
    for (const std::size_t terms : kTerms) {
        figures.push_back(
            {.key = key_of(peer, terms, basis),
             .meaning = fmt::format("{}'s time {} / ours, {} terms, worse of 1 and 2 threads",
                                    name, name_from(basis), terms),
             .aim = Aim::at_least,
             .target = target});
    }
}

}  // namespace

FigureGroup peer_figures() {
    FigureGroup group{.figures = {}, .measure = measure};
    for (const PeerBasis basis : kPeerBases) {
        append_figures("eigen", "Eigen", 6, basis, group.figures);
        append_figures("ng03", "[Ng03]", 5, basis, group.figures);
    }
    return group;
}

}  // namespace relume::bench
