// One image of sums per band, and their running total.
#pragma once

#include "server/engine/column_change.h"
#include "server/engine/scene.h"
#include "server/engine/strip_matrix.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::engine {

// Most sessions that are relit in one sweep.
inline constexpr std::size_t kMaxBatchMembers = 16;

// Sums are [blocks][3][256], in the basis of the blocks, before tint. A block's sums are made
// by one thread in one order, so the result does not depend on the number of threads. Not
// thread-safe.
class BandImages {
  public:
    explicit BandImages(const Scene& scene);

    // Sets the bands of the mask to zero, adds the changes (ordered by band), and brings the
    // total up to date, by adding and taking away. What that leaves behind of what a band held
    // is part of rounding_error(); nothing is left where all bands were reset.
    void update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes);

    [[nodiscard]] std::span<const float> total() const { return total_; }
    [[nodiscard]] std::span<const float> band(std::uint32_t band) const { return bands_[band]; }

    // Estimated rounding error left in the total by additions since it and each band were last
    // made from nothing, as an L2 norm: of each ε·√(Σ_updates ‖image‖²).
    [[nodiscard]] double rounding_error() const;
    // Who contributes most to it: the total, which is made anew from the bands, or a band.
    [[nodiscard]] bool total_drifted_most() const;
    [[nodiscard]] std::uint32_t most_drifted_band() const;
    void renew_total();
    // Makes the band from nothing, and the total from the bands.
    void renew_band(std::uint32_t band, const ColumnWeights& weights);

    // What `update` does to each of several images of one scene, at most kMaxBatchMembers, in
    // one sweep over the shards, so that what they have in common is read from memory once. The
    // same bits, whoever is swept together.
    struct Update {
        BandImages* images = nullptr;  // no two the same
        std::uint32_t bands_to_clear = 0;
        std::span<const ColumnChange> changes;
    };
    static void update_together(std::span<const Update> updates);

    // For images made from nothing, some blocks at a time, and again several of them in one
    // sweep: all bands and the total of blocks [first, last) become the whole product by the
    // weights. Every block must get its turn with the same weights before the total means
    // anything. Depends on the weights alone, to the last bit.
    struct Rebuild {
        BandImages* images = nullptr;  // no two the same
        const ColumnWeights* weights = nullptr;
    };
    static void rebuild_together(std::uint32_t first_block,
                                 std::uint32_t last_block,
                                 std::span<const Rebuild> rebuilds);

  private:
    // What additions to a band have left in it. Its norm is measured now and then, for that
    // takes as long as adding a few columns; in between it is bounded by what was added.
    struct Drift {
        double norm = 0;             // not less than ‖band‖
        double known_norm = 0;       // when it was last measured, or begun from nothing
        unsigned updates_since = 0;  // it was known
        double squared_norms = 0;    // Σ_updates

        // Made from nothing, nobody knows how large.
        [[nodiscard]] static Drift of_unknown_norm() { return {.updates_since = ~0U}; }
        [[nodiscard]] bool is_unknown() const { return updates_since == ~0U; }
        // An update of so many columns adds so much at most; whether the norm must be measured
        // after it.
        bool add(double norm_of_changes, std::size_t changes);
        void update_is_done() { squared_norms += norm * norm; }
    };

    // `bands_to_measure` of each update.
    static void update_shard(std::size_t shard,
                             std::span<const Update> updates,
                             std::span<const std::uint32_t> bands_to_measure);
    // What an update does to the drift; the mask of the bands whose norm is to be measured.
    [[nodiscard]] std::uint32_t begin_update(const Update& update);
    void end_update(const Update& update, std::uint32_t bands_measured);
    void update_bands(std::size_t shard, const Update& update);
    static void rebuild_block(std::uint32_t block, std::span<const Rebuild> rebuilds);
    void clear_band(std::uint32_t block, std::uint32_t band);
    // The same, and from the total.
    void remove_band(std::uint32_t block, std::uint32_t band);
    void measure_energy(std::size_t shard, std::uint32_t band);
    void sum_bands(std::uint32_t block);
    // Not less than the total's.
    [[nodiscard]] double total_norm() const;
    [[nodiscard]] double measured_norm(std::uint32_t band) const;
    [[nodiscard]] double norm_of(std::span<const ColumnChange> changes) const;
    // Sums of a block and, as they lie one after the other, of those that follow.
    [[nodiscard]] static float* sums_of(std::vector<float>& image, std::uint32_t block);

    const Scene* scene_;
    std::vector<std::vector<float>> bands_;
    std::vector<float> total_;
    std::vector<Drift> drift_;  // [bands]
    // Σ_updates of a band ‖total‖², since the bands were summed.
    double total_squared_norms_ = 0;
    // In the update under way: a band is reset of which nobody knows how much taking it away
    // would leave behind.
    bool total_is_resummed_ = false;
    std::vector<std::uint32_t> occupied_;  // [blocks], bands that are not zero all over
    std::vector<double> energies_;  // [shards][bands], Σ of squared band sums when measured
};

}  // namespace relume::engine
