#include "precompute/bake/receivers/vertex/cluster_order.h"

#include "protocol/transport/format.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace relume::bake {
namespace {

constexpr std::size_t kDimensions = 6;
using Place = std::array<float, kDimensions>;

class Halver {
  public:
    Halver(const VertexTable& vertices, std::span<std::uint32_t> order, float normal_weight)
        : vertices_(vertices), order_(order) {
        const Place sizes = extents(order);
        normal_scale_ = normal_weight * std::max({sizes[0], sizes[1], sizes[2]});
    }

    // Cuts into clusters, and calls found(first, last) for each in turn.
    template <typename Found>
    void cut_clusters(std::size_t first, std::size_t last, Found found) {
        if (last - first <= transport::kBlockSize) {
            cut_slots(first, last, transport::kBlockSize);
            found(first, last);
            return;
        }
        const std::size_t middle = cut_between_clusters(first, last);
        cut_clusters(first, middle, found);
        cut_clusters(middle, last, found);
    }

  private:
    void cut_slots(std::size_t first, std::size_t last, std::size_t room) {
        for (std::size_t half = room / 2; half > 0; half /= 2) {
            const std::size_t middle = first + half;
            if (middle < last) {
                halve(first, middle, last);
                cut_slots(middle, last, half);
                last = middle;
            }
        }
    }

    // Sorts along the widest extent and returns where to cut: at the widest gap, where it is
    // wide, else in the middle, after full clusters.
    std::size_t cut_between_clusters(std::size_t first, std::size_t last) {
        constexpr float kWide = 0.25F;  // of the extent
        const auto some = order_.subspan(first, last - first);
        const Place sizes = extents(some);
        const std::size_t widest = widest_of(sizes);
        const auto along = [&](std::uint32_t vertex) { return place_of(vertex)[widest]; };
        std::sort(some.begin(), some.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(along(a), a) < std::pair(along(b), b);
        });
        float widest_gap = kWide * sizes[widest];
        const std::size_t clusters =
            (some.size() + transport::kBlockSize - 1) / transport::kBlockSize;
        std::size_t cut = clusters / 2 * transport::kBlockSize;
        for (std::size_t i = transport::kBlockSize; i + transport::kBlockSize <= some.size();
             ++i) {
            const float gap = along(some[i]) - along(some[i - 1]);
            if (gap > widest_gap) {
                widest_gap = gap;
                cut = i;
            }
        }
        return first + cut;
    }

    [[nodiscard]] static std::size_t widest_of(const Place& sizes) {
        return static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) -
                                        sizes.begin());
    }

    void halve(std::size_t first, std::size_t middle, std::size_t last) {
        const std::size_t widest = widest_of(extents(order_.subspan(first, last - first)));
        const auto at = [&](std::size_t i) {
            return order_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(
            at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(place_of(a)[widest], a) < std::pair(place_of(b)[widest], b);
            });
    }

    [[nodiscard]] Place place_of(std::uint32_t vertex) const {
        const Imath::V3f& p = vertices_.positions[vertex];
        const Imath::V3f n = vertices_.normals[vertex] * normal_scale_;
        return {p.x, p.y, p.z, n.x, n.y, n.z};
    }

    [[nodiscard]] Place extents(std::span<const std::uint32_t> some) const {
        Place low = place_of(some[0]);
        Place high = low;
        for (const std::uint32_t vertex : some) {
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
    std::span<std::uint32_t> order_;
    float normal_scale_ = 0;
};

}  // namespace

ClusterOrder cluster_order(const VertexTable& vertices, float normal_weight) {
    ClusterOrder order;
    order.old_from_new.resize(vertices.materials.size());
    std::iota(order.old_from_new.begin(), order.old_from_new.end(), 0U);
    std::stable_sort(order.old_from_new.begin(), order.old_from_new.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return vertices.materials[a] < vertices.materials[b];
                     });
    const std::size_t count = order.old_from_new.size();
    for (std::size_t first = 0; first < count;) {
        const std::uint32_t material = vertices.materials[order.old_from_new[first]];
        std::size_t last = first;
        while (last < count && vertices.materials[order.old_from_new[last]] == material) {
            ++last;
        }
        const auto mine = std::span(order.old_from_new).subspan(first, last - first);
        Halver(vertices, mine, normal_weight)
            .cut_clusters(0, mine.size(), [&](std::size_t from, std::size_t to) {
                order.clusters.push_back({.first = static_cast<std::uint32_t>(first + from),
                                          .count = static_cast<std::uint32_t>(to - from),
                                          .material = material});
            });
        first = last;
    }
    return order;
}

}  // namespace relume::bake
