// The receivers of a bake, of whatever kind: what one stands for, which are close to each
// other, which are stored together.
//
// A receiver is an index below receiver_count(). Those who bake rows know nothing else of it: a
// new kind of receiver is a class of its own beside pixel/.
#pragma once

#include "precompute/bake/receivers/receiver.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

// Slots of one block that lie side by side, a receiver's or not, and which of them are
// neighbours, as pairs of indices into `slots`: there gradients of the image can be measured.
struct BlockPatch {
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
    // Blocks of at most 256 receivers, in the order in which they are baked and stored.
    [[nodiscard]] virtual std::uint32_t block_count() const = 0;
    // Blocks that are baked together, at most: close to each other in the scene.
    [[nodiscard]] virtual std::uint32_t blocks_per_shard() const = 0;
    // None where the slot is no receiver's. Slots in ascending order hold receivers in
    // ascending order.
    [[nodiscard]] virtual std::optional<std::size_t> receiver_at(std::uint32_t block,
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
    // Receivers of these blocks and all their neighbours, and perhaps some more: ascending,
    // disjoint.
    [[nodiscard]] virtual std::vector<ReceiverRun> reach(std::uint32_t first_block,
                                                         std::uint32_t block_count,
                                                         std::uint32_t radius) const = 0;
    // Receivers below it are in reach of no block from `first_block` on.
    [[nodiscard]] virtual std::size_t first_in_reach(std::uint32_t first_block,
                                                     std::uint32_t radius) const = 0;
    // While shards are baked one after another.
    [[nodiscard]] virtual ReachBound most_in_reach(std::uint32_t radius) const = 0;

    // Receivers that stand for others, ascending: one for a block; about `count` of all, spread
    // evenly.
    [[nodiscard]] virtual std::size_t middle_of_block(std::uint32_t block) const = 0;
    [[nodiscard]] virtual std::vector<std::size_t> spread_over_all(std::size_t count) const = 0;
    // The same in every block.
    [[nodiscard]] virtual BlockPatch patch() const = 0;
};

}  // namespace relume::bake
