// The pixels of an image without the surfaces of materials that people edit: what is left of
// them is baked as an image is, and multiplied with the light.
#pragma once

#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/receivers/receivers.h"

#include <vector>

namespace relume::bake {

class UneditedReceivers final : public Receivers {
  public:
    // `is_edited`: by material of the scene. Keeps a reference to `pixels`.
    UneditedReceivers(const PixelReceivers& pixels, std::vector<bool> is_edited);

    [[nodiscard]] std::size_t receiver_count() const override {
        return pixels_.receiver_count();
    }
    [[nodiscard]] std::uint32_t cluster_count() const override {
        return pixels_.cluster_count();
    }
    [[nodiscard]] std::uint32_t terms(std::uint32_t cluster) const override {
        return pixels_.terms(cluster);
    }
    [[nodiscard]] std::span<const transport::BlockBasis> block_bases() const override {
        return pixels_.block_bases();
    }
    [[nodiscard]] std::uint32_t clusters_per_shard() const override {
        return pixels_.clusters_per_shard();
    }
    [[nodiscard]] std::optional<std::size_t> receiver_at(std::uint32_t cluster,
                                                         std::uint32_t slot) const override {
        return pixels_.receiver_at(cluster, slot);
    }
    // Surfaces keep their shares and their numbers.
    [[nodiscard]] Receiver look(std::size_t receiver) const override;
    [[nodiscard]] std::vector<Receiver> points(std::size_t receiver,
                                               std::uint64_t seed) const override;
    void find_neighbours(std::size_t receiver,
                         std::uint32_t radius,
                         std::vector<Neighbour>& neighbours) const override {
        pixels_.find_neighbours(receiver, radius, neighbours);
    }
    [[nodiscard]] std::vector<ReceiverRun> reach(std::uint32_t first_cluster,
                                                 std::uint32_t cluster_count,
                                                 std::uint32_t radius) const override {
        return pixels_.reach(first_cluster, cluster_count, radius);
    }
    [[nodiscard]] std::size_t first_in_reach(std::uint32_t first_cluster,
                                             std::uint32_t radius) const override {
        return pixels_.first_in_reach(first_cluster, radius);
    }
    [[nodiscard]] ReachBound most_in_reach(std::uint32_t radius) const override {
        return pixels_.most_in_reach(radius);
    }
    [[nodiscard]] std::size_t middle_of_cluster(std::uint32_t cluster) const override {
        return pixels_.middle_of_cluster(cluster);
    }
    [[nodiscard]] std::vector<std::size_t> spread_over_all(std::size_t count) const override {
        return pixels_.spread_over_all(count);
    }
    [[nodiscard]] ClusterPatch patch() const override { return pixels_.patch(); }

  private:
    void leave_out_edited(Receiver& receiver) const;

    const PixelReceivers& pixels_;
    std::vector<bool> is_edited_;
};

}  // namespace relume::bake
