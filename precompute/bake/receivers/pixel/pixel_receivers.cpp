#include "precompute/bake/receivers/pixel/pixel_receivers.h"

#include "protocol/sampling/sobol.h"
#include "protocol/transport/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::bake {

using transport::kTileSide;

SequencePlace sequence_place_from_pixel(std::uint32_t x, std::uint32_t y) {
    return {.run = sampling::morton_index(x, y),
            .along = 0.7548776662466927 * x + 0.5698402909980532 * y,
            .across = 0.5698402909980532 * x + 0.2451223337533073 * y};
}

PixelReceivers::PixelReceivers(const RayCaster& caster, const BakeParameters& parameters)
    : caster_(caster),
      image_{.width = parameters.width, .height = parameters.height},
      camera_(caster.scene().camera, image_.width, image_.height),
      finer_camera_(caster.scene().camera, image_.width * kFiner, image_.height * kFiner),
      pixel_samples_(parameters.pixel_samples),
      seed_(parameters.seed) {}

PixelView PixelReceivers::view(std::uint32_t x, std::uint32_t y) const {
    return view_pixel(caster_, camera_, x, y, pixel_samples_, seed_);
}

std::size_t PixelReceivers::receiver_count() const {
    return std::size_t{image_.width} * image_.height;
}

std::uint32_t PixelReceivers::clusters_per_shard() const {
    const std::uint32_t rows = transport::kMaxBlocksPerShard / image_.tiles_x();
    return rows > 0 ? rows * image_.tiles_x() : transport::kMaxBlocksPerShard;
}

std::optional<std::size_t> PixelReceivers::receiver_at(std::uint32_t cluster,
                                                       std::uint32_t slot) const {
    const Box box = tile(cluster);
    const std::uint32_t x = box.left + slot % kTileSide;
    const std::uint32_t y = box.top + slot / kTileSide;
    if (x >= box.right || y >= box.bottom) {
        return std::nullopt;
    }
    return receiver_from_pixel(x, y);
}

Receiver PixelReceivers::look(std::size_t receiver) const {
    const auto [x, y] = pixel_from_receiver(receiver);
    return {.index = receiver,
            .place = sequence_place_from_pixel(x, y),
            .surfaces = view(x, y).surfaces};
}

std::vector<Receiver> PixelReceivers::points(std::size_t receiver, std::uint64_t seed) const {
    // Along both sides of a pixel, a point in each; the second where surfaces meet.
    constexpr std::uint32_t kParts = 2;
    constexpr std::uint32_t kEdgeParts = 4;
    const auto [x, y] = pixel_from_receiver(receiver);
    const PixelView seen = view(x, y);
    const bool meets_edge = seen.surfaces.size() > 1 || seen.coverage < 1;
    const std::uint32_t parts = meets_edge ? kEdgeParts : kParts;
    const std::uint32_t side = kFiner / parts;
    std::vector<Receiver> points;
    for (std::uint32_t part = 0; part < parts * parts; ++part) {
        const std::uint64_t bits =
            transport::mix_bits(seed + receiver * kEdgeParts * kEdgeParts + part);
        const std::uint32_t column =
            x * kFiner + part % parts * side + static_cast<std::uint32_t>(bits) % side;
        const std::uint32_t row =
            y * kFiner + part / parts * side + static_cast<std::uint32_t>(bits >> 32U) % side;
        points.push_back(
            {.index = receiver,
             .place = sequence_place_from_pixel(column, row),
             .surfaces = view_pixel(caster_, finer_camera_, column, row, 1, seed).surfaces});
    }
    return points;
}

void PixelReceivers::find_neighbours(std::size_t receiver,
                                     std::uint32_t radius,
                                     std::vector<Neighbour>& neighbours) const {
    const auto [x, y] = pixel_from_receiver(receiver);
    const Box box = grown({.left = x, .top = y, .right = x + 1, .bottom = y + 1}, radius);
    neighbours.clear();
    for (std::uint32_t row = box.top; row < box.bottom; ++row) {
        for (std::uint32_t column = box.left; column < box.right; ++column) {
            const float dx = static_cast<float>(column) - static_cast<float>(x);
            const float dy = static_cast<float>(row) - static_cast<float>(y);
            neighbours.push_back({.receiver = receiver_from_pixel(column, row),
                                  .squared_distance = dx * dx + dy * dy});
        }
    }
}

std::vector<ReceiverRun> PixelReceivers::reach(std::uint32_t first_cluster,
                                               std::uint32_t cluster_count,
                                               std::uint32_t radius) const {
    // Boxes of the clusters' parts of each tile row, in the order of the rows.
    std::vector<Box> boxes;
    for (std::uint32_t cluster = first_cluster; cluster < first_cluster + cluster_count;) {
        const std::uint32_t in_row = std::min(image_.tiles_x() - cluster % image_.tiles_x(),
                                              first_cluster + cluster_count - cluster);
        Box box = tile(cluster);
        box.right = tile(cluster + in_row - 1).right;
        boxes.push_back(grown(box, radius));
        cluster += in_row;
    }
    std::vector<ReceiverRun> runs;
    for (std::uint32_t y = boxes.front().top; y < boxes.back().bottom; ++y) {
        std::vector<ReceiverRun> row;
        for (const Box& box : boxes) {
            if (box.top <= y && y < box.bottom) {
                row.push_back({.first = receiver_from_pixel(box.left, y),
                               .last = receiver_from_pixel(box.right - 1, y) + 1});
            }
        }
        std::sort(row.begin(), row.end(),
                  [](const ReceiverRun& a, const ReceiverRun& b) { return a.first < b.first; });
        const std::size_t before = runs.size();
        for (const ReceiverRun& run : row) {
            if (runs.size() > before && run.first <= runs.back().last) {
                runs.back().last = std::max(runs.back().last, run.last);
            } else {
                runs.push_back(run);
            }
        }
    }
    return runs;
}

std::size_t PixelReceivers::first_in_reach(std::uint32_t first_cluster,
                                           std::uint32_t radius) const {
    return receiver_from_pixel(0, grown(tile(first_cluster), radius).top);
}

ReachBound PixelReceivers::most_in_reach(std::uint32_t radius) const {
    // The tile rows of a shard and the reach on both sides.
    const std::uint32_t tile_rows =
        std::max(1U, transport::kMaxBlocksPerShard / image_.tiles_x());
    const std::uint64_t rows =
        std::min(std::uint64_t{tile_rows} * kTileSide + 2 * std::uint64_t{radius},
                 std::uint64_t{image_.height});
    return {.receivers = rows * image_.width,
            .shown = fmt::format("{} rows of {} pixels", rows, image_.width),
            .remedy = "a narrower image"};
}

std::size_t PixelReceivers::middle_of_cluster(std::uint32_t cluster) const {
    const Box box = tile(cluster);
    return receiver_from_pixel(std::min(box.left + kTileSide / 2, image_.width - 1),
                               std::min(box.top + kTileSide / 2, image_.height - 1));
}

std::vector<std::size_t> PixelReceivers::spread_over_all(std::size_t count) const {
    const double area = static_cast<double>(image_.width) * image_.height;
    const auto spacing =
        std::max(1U, static_cast<std::uint32_t>(std::sqrt(area / static_cast<double>(count))));
    std::vector<std::size_t> receivers;
    for (std::uint32_t y = spacing / 2; y < image_.height; y += spacing) {
        for (std::uint32_t x = spacing / 2; x < image_.width; x += spacing) {
            receivers.push_back(receiver_from_pixel(x, y));
        }
    }
    return receivers;
}

ClusterPatch PixelReceivers::patch() const {
    constexpr std::uint32_t kFirst = (kTileSide / 2 - 1) * (kTileSide + 1);
    return {.slots = {kFirst, kFirst + 1, kFirst + kTileSide, kFirst + kTileSide + 1},
            .neighbours = {{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
}

PixelReceivers::Box PixelReceivers::tile(std::uint32_t cluster) const {
    const std::uint32_t left = cluster % image_.tiles_x() * kTileSide;
    const std::uint32_t top = cluster / image_.tiles_x() * kTileSide;
    return {.left = left,
            .top = top,
            .right = std::min(left + kTileSide, image_.width),
            .bottom = std::min(top + kTileSide, image_.height)};
}

PixelReceivers::Box PixelReceivers::grown(const Box& box, std::uint32_t radius) const {
    return {.left = box.left > radius ? box.left - radius : 0,
            .top = box.top > radius ? box.top - radius : 0,
            .right = std::min(box.right + radius, image_.width),
            .bottom = std::min(box.bottom + radius, image_.height)};
}

PixelReceivers::Pixel PixelReceivers::pixel_from_receiver(std::size_t receiver) const {
    return {.x = static_cast<std::uint32_t>(receiver % image_.width),
            .y = static_cast<std::uint32_t>(receiver / image_.width)};
}

std::size_t PixelReceivers::receiver_from_pixel(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y} * image_.width + x;
}

}  // namespace relume::bake
