// Vertices of a refined surface: each has a row for every term of its material's BRDF, steps
// are mean lengths of edges, and what is stored together is a cluster.
#pragma once

#include "precompute/bake/receivers/receivers.h"
#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/scene/scene.h"
#include "protocol/brdf/factored_brdf.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace relume::bake {

class VertexReceivers final : public Receivers {
  public:
    // `brdfs` are those of the scene's materials, [materials]; materials without a vertex may
    // have null. Keeps references to all.
    VertexReceivers(const scene::Scene& scene,
                    const RefinedSurface& surface,
                    std::vector<const brdf::FactoredBrdf*> brdfs);

    [[nodiscard]] const RefinedSurface& surface() const { return surface_; }
    [[nodiscard]] const brdf::FactoredBrdf& brdf_of_material(std::uint32_t material) const {
        return *brdfs_[material];
    }

    [[nodiscard]] std::size_t receiver_count() const override;
    [[nodiscard]] std::uint32_t cluster_count() const override;
    [[nodiscard]] std::uint32_t terms(std::uint32_t cluster) const override;
    [[nodiscard]] std::span<const transport::BlockBasis> block_bases() const override {
        static constexpr std::array kBases{transport::BlockBasis::haar_line,
                                           transport::BlockBasis::identity};
        return kBases;
    }
    // Few: while a view moves, a server passes by shards that it does not see.
    [[nodiscard]] std::uint32_t clusters_per_shard() const override { return 4; }
    [[nodiscard]] std::optional<std::size_t> receiver_at(std::uint32_t cluster,
                                                         std::uint32_t slot) const override;
    [[nodiscard]] Receiver look(std::size_t receiver) const override;
    // The vertex itself, with other random numbers.
    [[nodiscard]] std::vector<Receiver> points(std::size_t receiver,
                                               std::uint64_t seed) const override;
    // Those that `radius` edges lead to, within the group of the vertex. Ring by ring.
    void find_neighbours(std::size_t receiver,
                         std::uint32_t radius,
                         std::vector<Neighbour>& neighbours) const override;
    // Groups, as runs.
    [[nodiscard]] std::vector<ReceiverRun> reach(std::uint32_t first_cluster,
                                                 std::uint32_t cluster_count,
                                                 std::uint32_t radius) const override;
    [[nodiscard]] std::size_t first_in_reach(std::uint32_t first_cluster,
                                             std::uint32_t radius) const override;
    [[nodiscard]] ReachBound most_in_reach(std::uint32_t radius) const override;
    [[nodiscard]] std::size_t middle_of_cluster(std::uint32_t cluster) const override;
    [[nodiscard]] std::vector<std::size_t> spread_over_all(std::size_t count) const override;
    // The first four slots.
    [[nodiscard]] ClusterPatch patch() const override;

  private:
    // Clusters close to each other, whose vertices share paths. A vertex shares none with those
    // of other groups, so that the paths that are kept at once do not grow with the surface.
    static constexpr std::uint32_t kClustersPerGroup = 16;

    [[nodiscard]] std::size_t cluster_of(std::size_t vertex) const;
    // First vertex of a group, or the count of vertices behind the last group.
    [[nodiscard]] std::size_t first_of_group(std::size_t group) const;
    [[nodiscard]] Receiver receiver(std::size_t vertex, std::uint32_t run) const;

    const scene::Scene& scene_;
    const RefinedSurface& surface_;
    std::vector<const brdf::FactoredBrdf*> brdfs_;
};

}  // namespace relume::bake
