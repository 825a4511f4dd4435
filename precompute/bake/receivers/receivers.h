// The receivers of a bake, of whatever kind: what one stands for, which are close to each
// other, which are stored together.
//
// A receiver is an index below receiver_count(). Those who bake rows know nothing else of it: a
// new kind of receiver is a class of its own beside pixel/.
#pragma once

#include "precompute/bake/receivers/receiver.h"
#include "protocol/transport/block_basis.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::bake {

// Receivers [first, last).
struct ReceiverRun {
    std::size_t first = 0;
    std::size_t last = 0;

    friend bool operator==(const ReceiverRun&, const ReceiverRun&) = default;
};

// Distances are in steps: from a receiver to the one beside it is one.
struct Neighbour {
    std::size_t receiver = 0;
    float squared_distance = 0;
};

// Slots of one cluster that lie side by side, a receiver's or not, and which of them are
// neighbours, as pairs of indices into `slots`: there gradients of the image can be measured.
struct ClusterPatch {
    std::vector<std::uint32_t> slots;
    std::vector<std::array<std::size_t, 2>> neighbours;
};

// How many receivers can be in reach at once, with words for a message: what they are, and what
// would make them fewer.
struct ReachBound {
    std::uint64_t receivers = 0;
    std::string shown;
    std::string remedy;
};

// All answers depend on nothing but the arguments and what the class was made of. Thread-safe.
class Receivers {
  public:
    Receivers() = default;
    Receivers(const Receivers&) = delete;
    Receivers& operator=(const Receivers&) = delete;
    virtual ~Receivers() = default;

    [[nodiscard]] virtual std::size_t receiver_count() const = 0;
    // Clusters of at most 256 receivers, in the order in which they are baked and stored.
    [[nodiscard]] virtual std::uint32_t cluster_count() const = 0;
    // Rows of every receiver of a cluster, 1 … transport::kMaxTerms. Each is stored in a block
    // of its own.
    [[nodiscard]] virtual std::uint32_t terms(std::uint32_t cluster) const = 0;
    // In which their blocks may be stored, at least one: the bake takes the one that needs the
    // fewest bytes. Valid as long as the receivers.
    [[nodiscard]] virtual std::span<const transport::BlockBasis> block_bases() const = 0;
    // Clusters that are baked together, at most: close to each other in the scene.
    [[nodiscard]] virtual std::uint32_t clusters_per_shard() const = 0;
    // None where the slot is no receiver's. Slots in ascending order hold receivers in
    // ascending order.
    [[nodiscard]] virtual std::optional<std::size_t> receiver_at(std::uint32_t cluster,
                                                                 std::uint32_t slot) const = 0;

    [[nodiscard]] virtual Receiver look(std::size_t receiver) const = 0;
    // Points, with random numbers of their own, whose mean is the receiver without any bias:
    // over all seeds, rows of points average to the row of what the receiver stands for. They
    // take the receiver's index.
    [[nodiscard]] virtual std::vector<Receiver> points(std::size_t receiver,
                                                       std::uint64_t seed) const = 0;

    // Replaces `neighbours` by those within `radius` steps, itself among them, in an order that
    // is always the same.
    virtual void find_neighbours(std::size_t receiver,
                                 std::uint32_t radius,
                                 std::vector<Neighbour>& neighbours) const = 0;
    // Receivers of these clusters and all their neighbours, and perhaps some more: ascending,
    // disjoint.
    [[nodiscard]] virtual std::vector<ReceiverRun> reach(std::uint32_t first_cluster,
                                                         std::uint32_t cluster_count,
                                                         std::uint32_t radius) const = 0;
    // Receivers below it are in reach of no cluster from `first_cluster` on.
    [[nodiscard]] virtual std::size_t first_in_reach(std::uint32_t first_cluster,
                                                     std::uint32_t radius) const = 0;
    // While shards are baked one after another.
    [[nodiscard]] virtual ReachBound most_in_reach(std::uint32_t radius) const = 0;

    // Receivers that stand for others, ascending: one for a cluster; about `count` of all,
    // spread evenly.
    [[nodiscard]] virtual std::size_t middle_of_cluster(std::uint32_t cluster) const = 0;
    [[nodiscard]] virtual std::vector<std::size_t> spread_over_all(std::size_t count) const = 0;
    // The same in every cluster.
    [[nodiscard]] virtual ClusterPatch patch() const = 0;
};

}  // namespace relume::bake
