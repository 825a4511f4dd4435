// One image of sums per band, and their running total.
#pragma once

#include "server/engine/column_change.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::engine {

// Sums are [blocks][3][256], in the basis of the blocks, before tint. Work is spread over
// shards; a block's sums are made by one thread in one order, so the result does not depend on
// the number of threads. Not thread-safe.
class BandImages {
  public:
    explicit BandImages(const Scene& scene);

    // Sets the bands of the mask to zero, adds the changes (ordered by band), and brings the
    // total up to date: by adding when no band was reset, by summing the bands anew where one
    // was, so that nothing stays behind of what the band held [DESIGN §7.4].
    void update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes);

    [[nodiscard]] std::span<const float> total() const { return total_; }
    [[nodiscard]] std::span<const float> band(std::uint32_t band) const { return bands_[band]; }

    // Estimated rounding error left in the total by additions since each band was last made
    // from nothing, as an L2 norm: per band ε/2 · (largest norm it had) · √updates.
    [[nodiscard]] double rounding_error() const;
    // The band that contributes most to it.
    [[nodiscard]] std::uint32_t most_drifted_band() const;

    // What `update` does to each of several images of one scene, at most kMaxBatchMembers, in
    // one sweep over the columns. The same bits, whoever is swept together.
    struct Update {
        BandImages* images = nullptr;  // no two the same
        std::uint32_t bands_to_clear = 0;
        std::span<const ColumnChange> changes;
    };
    static void update_together(std::span<const Update> updates);

    // For images made from nothing, some shards at a time, and again several of them in one
    // sweep: all bands and the total of shards [first, last) become the product of the
    // lighting, planar [3][N]. Every shard must get its turn with the same lighting before the
    // total means anything. Depends on the lighting alone, to the last bit.
    struct Rebuild {
        BandImages* images = nullptr;  // no two the same
        std::span<const float> lighting;
    };
    static void rebuild_together(std::size_t first_shard,
                                 std::size_t last_shard,
                                 std::span<const Rebuild> rebuilds);

  private:
    struct Drift {
        double largest_norm = 0;
        double updates = 0;

        [[nodiscard]] double error() const;
    };

    static void update_shard(std::size_t shard, std::span<const Update> updates);
    static void rebuild_shard(std::size_t shard, std::span<const Rebuild> rebuilds);
    void clear_band(std::size_t shard, std::uint32_t band);
    void record_energy(std::size_t shard, std::uint32_t band);
    void sum_bands(std::size_t shard);
    void record_drift(std::uint32_t band, bool cleared);
    [[nodiscard]] std::span<float> part(std::vector<float>& image, std::size_t shard) const;

    const Scene* scene_;
    std::vector<std::vector<float>> bands_;
    std::vector<float> total_;
    std::vector<Drift> drift_;      // [bands]
    std::vector<double> energies_;  // [shards][bands], Σ of squared band sums
};

}  // namespace relume::engine
