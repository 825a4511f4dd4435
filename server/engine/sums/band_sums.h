// The running total of the columns shown, and images of what it holds of the bands.
#pragma once

#include "server/engine/columns/column_change.h"
#include "server/engine/operators/transport_operator.h"
#include "server/engine/sums/drift.h"
#include "server/engine/sums/loose_columns.h"
#include "server/engine/sums/receiver_sums.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::engine {

// Most sessions that are relit in one sweep.
inline constexpr std::size_t kMaxBatchMembers = 16;

// Sums are [blocks][3][256], in the basis of the blocks, before tint. The total is what the
// bands' images and the loose columns add up to. A band has no image, and takes no memory,
// before a whole product or very many columns gave it one. A block's sums are made by one
// thread in one order, so the result does not depend on the number of threads. Not thread-safe.
class BandSums {
  public:
    explicit BandSums(const TransportOperator& of);

    // Takes the bands of the mask out of the total and adds the changes, which are ordered by
    // band and index and relative to that. What rounding leaves is part of rounding_error();
    // nothing is left where all bands were cleared.
    void update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes);

    [[nodiscard]] std::span<const float> total() const { return total_.sums(); }
    // Of the columns that the last update added, those taken back among them.
    [[nodiscard]] std::uint64_t bytes_added() const { return bytes_added_; }
    // Memory for what the bands hold, beside the total: images and loose columns.
    [[nodiscard]] std::uint64_t bytes_of_bands() const;

    // Estimated rounding error that additions have left in the total since it was last made, as
    // an L2 norm, ε·√(Σ_updates ‖total‖²).
    [[nodiscard]] double rounding_error_of_total() const;
    // Makes the total anew from the bands' images and the loose columns.
    void renew_total();
    // The same of the bands' images, which no making anew of the total removes; and where loose
    // columns take back much of a band's image, what that leaves of it (known from the last
    // renewal of the total on).
    [[nodiscard]] double rounding_error_of_bands() const;
    // The band to blame most for it.
    [[nodiscard]] std::uint32_t most_drifted_band() const;
    // Makes the band's image from nothing, of all that is shown of the band, and the total
    // anew.
    void renew_band(std::uint32_t band, const TransportOperator::Weights& weights);

    // What `update` does to each of several images of one scene, at most kMaxBatchMembers, in
    // one sweep over the shards, so that what they have in common is read from memory once. The
    // same bits, whoever is swept together.
    struct Update {
        BandSums* sums = nullptr;  // no two the same
        std::uint32_t bands_to_clear = 0;
        std::span<const ColumnChange> changes;
    };
    static void update_together(std::span<const Update> updates);

    // For images made from nothing, some blocks at a time, and again several of them in one
    // sweep: all bands and the total of blocks [first, last) become the whole product by the
    // weights. Every block must get its turn with the same weights before the total means
    // anything. Depends on the weights alone, to the last bit.
    struct Rebuild {
        BandSums* sums = nullptr;  // no two the same
        const TransportOperator::Weights* weights = nullptr;
    };
    static void rebuild_together(std::uint32_t first_block,
                                 std::uint32_t last_block,
                                 std::span<const Rebuild> rebuilds);

  private:
    // An update under way.
    struct Step {
        bool begins_anew = false;             // with a black image
        std::uint32_t bands_to_remove = 0;    // that may have an image
        std::uint32_t images_to_measure = 0;  // a bit for each band's, one for the total's
        double norm_before = 0;               // of the total, at most
        double largest_norm = 0;  // at most, of what the total passes through while bands go
        LooseColumns::Split changes;
    };

    void begin_update(const Update& update);
    void update_run(std::size_t run);
    void end_update();
    static void rebuild_block(std::uint32_t block, std::span<const Rebuild> rebuilds);
    void make_band(std::uint32_t band);
    void clear_band(std::uint32_t block, std::uint32_t band);
    void remove_bands(std::uint32_t block);
    void sum_bands(std::uint32_t block);
    [[nodiscard]] std::uint32_t total_bit() const { return std::uint32_t{1} << bands_.size(); }
    // Images as a mask: bands, and the total.
    void measure(std::uint32_t block, std::uint32_t images);
    void take_measured_norms(std::uint32_t images);
    [[nodiscard]] double measured_norm(std::size_t image) const;
    // Of the part of a band's image that loose columns may have taken back.
    [[nodiscard]] double cancelled_norm(std::uint32_t band) const;
    [[nodiscard]] double squared_norms_of_band(std::uint32_t band) const;
    [[nodiscard]] double norm_of(std::span<const ColumnChange> changes) const;
    [[nodiscard]] std::uint64_t bytes_of(std::span<const ColumnChange> changes) const;

    const TransportOperator* operator_;
    std::vector<ReceiverSums> bands_;  // empty until something is in it
    ReceiverSums total_;
    LooseColumns loose_;
    Step step_;
    std::uint64_t bytes_added_ = 0;
    std::vector<Drift> drift_;             // [bands + 1], the last of the total
    std::vector<std::uint32_t> occupied_;  // [blocks], bands whose images are not zero all over
    std::vector<double> energies_;  // [blocks][bands + 1], Σ of squared sums when measured
};

}  // namespace relume::engine
