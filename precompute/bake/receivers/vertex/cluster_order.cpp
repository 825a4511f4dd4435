#include "precompute/bake/receivers/vertex/cluster_order.h"

#include "protocol/transport/format.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace relume::bake {
namespace {

constexpr std::size_t kCluster = transport::kBlockSize;
constexpr std::size_t kGroup = 4 * kCluster;

std::size_t clusters_of(std::size_t vertices) {
    return (vertices + kCluster - 1) / kCluster;
}

// By position and normal: into groups.
class SpaceCutter {
  public:
    SpaceCutter(const VertexTable& vertices, std::span<std::uint32_t> order)
        : vertices_(vertices) {
        const Place sizes = extents(order);
        normal_length_ = std::max({sizes[0], sizes[1], sizes[2]});
    }

    // Sorts and calls found(part) for each group in turn.
    template <typename Found>
    void cut(std::span<std::uint32_t> part, Found found) const {
        if (part.size() <= kGroup) {
            found(part);
            return;
        }
        const std::size_t middle = sort_and_choose(part);
        cut(part.first(middle), found);
        cut(part.subspan(middle), found);
    }
    // Sorts along the widest extent.
    void sort(std::span<std::uint32_t> part) const {
        sort_along(widest_of(extents(part)), part);
    }

  private:
    static constexpr std::size_t kDimensions = 6;
    using Place = std::array<float, kDimensions>;

    // Where to cut, counted from the first.
    std::size_t sort_and_choose(std::span<std::uint32_t> part) const {
        constexpr float kWide = 0.25F;  // of the extent
        const Place sizes = extents(part);
        const std::size_t widest = widest_of(sizes);
        sort_along(widest, part);
        float widest_gap = kWide * sizes[widest];
        std::size_t cut = clusters_of(part.size()) / 2 * kCluster;
        for (std::size_t i = kCluster; i + kCluster <= part.size(); ++i) {
            const float gap = place_of(part[i])[widest] - place_of(part[i - 1])[widest];
            if (gap > widest_gap) {
                widest_gap = gap;
                cut = i;
            }
        }
        return cut;
    }

    void sort_along(std::size_t dimension, std::span<std::uint32_t> part) const {
        std::sort(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(place_of(a)[dimension], a) < std::pair(place_of(b)[dimension], b);
        });
    }

    [[nodiscard]] static std::size_t widest_of(const Place& sizes) {
        return static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) -
                                        sizes.begin());
    }

    [[nodiscard]] Place place_of(std::uint32_t vertex) const {
        const Imath::V3f& p = vertices_.positions[vertex];
        const Imath::V3f n = vertices_.normals[vertex] * normal_length_;
        return {p.x, p.y, p.z, n.x, n.y, n.z};
    }

    [[nodiscard]] Place extents(std::span<const std::uint32_t> part) const {
        Place low = place_of(part[0]);
        Place high = low;
        for (const std::uint32_t vertex : part) {
            const Place place = place_of(vertex);
            for (std::size_t i = 0; i < kDimensions; ++i) {
                low[i] = std::min(low[i], place[i]);
                high[i] = std::max(high[i], place[i]);
            }
        }
        for (std::size_t i = 0; i < kDimensions; ++i) {
            high[i] -= low[i];
        }
        return high;
    }

    const VertexTable& vertices_;
    float normal_length_ = 0;
};

// By rows, where they differ: into clusters and slots.
class RowCutter {
  public:
    RowCutter(const VertexTable& vertices, const SpaceCutter& space)
        : vertices_(vertices), space_(space) {}

    template <typename Found>
    void cut_clusters(std::span<std::uint32_t> part, Found found) const {
        if (part.size() <= kCluster) {
            cut_slots(part, kCluster);
            found(part);
            return;
        }
        sort(part);
        const std::size_t middle = clusters_of(part.size()) / 2 * kCluster;
        cut_clusters(part.first(middle), found);
        cut_clusters(part.subspan(middle), found);
    }

  private:
    // `room` slots, of which the first are taken.
    void cut_slots(std::span<std::uint32_t> part, std::size_t room) const {
        if (part.size() <= 1) {
            return;
        }
        const std::size_t half = room / 2;
        if (part.size() <= half) {
            cut_slots(part, half);
            return;
        }
        sort(part);
        cut_slots(part.first(half), half);
        cut_slots(part.subspan(half), half);
    }

    void sort(std::span<std::uint32_t> part) const {
        const std::vector<double> places = along_widest_axis(vertices_.rows, part);
        if (places.empty()) {
            space_.sort(part);
            return;
        }
        std::vector<std::pair<double, std::uint32_t>> sorted;
        sorted.reserve(part.size());
        for (std::size_t i = 0; i < part.size(); ++i) {
            sorted.emplace_back(places[i], part[i]);
        }
        std::sort(sorted.begin(), sorted.end());
        std::transform(sorted.begin(), sorted.end(), part.begin(),
                       [](const auto& one) { return one.second; });
    }

    const VertexTable& vertices_;
    const SpaceCutter& space_;
};

}  // namespace

ClusterOrder cluster_order(const VertexTable& vertices) {
    ClusterOrder order;
    order.old_from_new.resize(vertices.materials.size());
    std::iota(order.old_from_new.begin(), order.old_from_new.end(), 0U);
    const auto material_of = [&](std::uint32_t vertex) { return vertices.materials[vertex]; };
    std::stable_sort(
        order.old_from_new.begin(), order.old_from_new.end(),
        [&](std::uint32_t a, std::uint32_t b) { return material_of(a) < material_of(b); });
    for (auto first = order.old_from_new.begin(); first != order.old_from_new.end();) {
        const std::uint32_t material = material_of(*first);
        const auto last =
            std::find_if(first, order.old_from_new.end(),
                         [&](std::uint32_t vertex) { return material_of(vertex) != material; });
        const std::span<std::uint32_t> mine(first, last);
        const SpaceCutter space(vertices, mine);
        const RowCutter rows(vertices, space);
        space.cut(mine, [&](std::span<std::uint32_t> group) {
            rows.cut_clusters(group, [&](std::span<std::uint32_t> cluster) {
                order.clusters.push_back({.first = static_cast<std::uint32_t>(
                                              cluster.data() - order.old_from_new.data()),
                                          .count = static_cast<std::uint32_t>(cluster.size()),
                                          .material = material});
            });
        });
        first = last;
    }
    return order;
}

}  // namespace relume::bake
