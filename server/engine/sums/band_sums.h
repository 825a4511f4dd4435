// The sums of the image that is shown (the *total*), and for some bands the sums of what the
// total holds of that band alone, so that the band can be taken out of it.
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

// Sums are [blocks][3][256], in the basis of the blocks, before tint. The sums of one band are
// called its image. The total equals the sum of the bands' images and of the loose columns
// (loose_columns.h). A band gets an image, and memory for it, from a whole product or when very
// many of its columns change. One thread makes a block's sums in one order, so the result does
// not depend on the number of threads. Not thread-safe.
class BandSums {
  public:
    explicit BandSums(const TransportOperator& of);

    // Takes the bands of the mask out of the total, then adds the changes. These are ordered by
    // band and index, and their `from` is what is shown once the bands have been taken out.
    // rounding_error_of_total() covers what rounding leaves of the bands; where all bands are
    // taken out the total is exactly zero.
    void update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes);

    // Which runs of the operator somebody looks at, [runs], not 0 where so; all at first.
    // Updates pass by the others, and what they miss is made up for here, when they are looked
    // at again: from the approximation, [3][N], that all updates so far have led to. Sums of
    // runs that are not looked at say nothing.
    void look_at(std::vector<std::uint8_t> runs, std::span<const float> approximation);

    [[nodiscard]] std::span<const float> total() const { return total_.sums(); }
    // Bytes of the columns that the last update added to sums, or took out of them.
    [[nodiscard]] std::uint64_t bytes_added() const { return bytes_added_; }
    // Bytes of memory beside the total: the bands' images and the loose columns.
    [[nodiscard]] std::uint64_t bytes_of_bands() const;

    // Estimated L2 norm of the rounding error that additions have left in the total since the
    // total was last made anew: ε·√(Σ_updates ‖total‖²).
    [[nodiscard]] double rounding_error_of_total() const;
    // Makes the total anew as the sum of the bands' images and the loose columns.
    void renew_total();
    // Estimated L2 norm of the rounding error in the bands' images. renew_total() adds these
    // images up and so keeps their errors; only renew_band() removes them. An image counts once
    // more where loose columns take back much of it: what is left is small beside what was
    // rounded. That part is measured by renew_total().
    [[nodiscard]] double rounding_error_of_bands() const;
    // The band that has the largest part in that error.
    [[nodiscard]] std::uint32_t most_drifted_band() const;
    // Makes the band's image anew from nothing, then the total. `weights` are those of the
    // approximation, of which the band's part is taken.
    void renew_band(std::uint32_t band, const TransportOperator::Weights& weights);

    // Does what `update` does to each of several sums over one operator, at most
    // kMaxBatchMembers, in one sweep over its runs, so that columns that several of them change
    // are read from memory once. Each gets the same bits alone and together with others.
    struct Update {
        BandSums* sums = nullptr;  // no two the same
        std::uint32_t bands_to_clear = 0;
        std::span<const ColumnChange> changes;
    };
    static void update_together(std::span<const Update> updates);

    // Makes sums from nothing, some blocks at a time and several sums in one sweep: in blocks
    // [first_block, last_block) the bands' images and the total become the product of T and the
    // weights. The sums are of use once every block has been made with the same weights. They
    // depend on the weights alone, to the last bit.
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

    void catch_up(std::size_t run, const TransportOperator::Weights& in_bands);
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
    std::vector<std::uint8_t> looked_at_;  // [runs]
    std::vector<std::uint8_t> stale_;      // [runs], not 0 where updates have been missed
    Step step_;
    std::uint64_t bytes_added_ = 0;
    std::vector<Drift> drift_;             // [bands + 1], the last of the total
    std::vector<std::uint32_t> occupied_;  // [blocks], bands whose images are not zero all over
    std::vector<double> energies_;  // [blocks][bands + 1], Σ of squared sums when measured
};

}  // namespace relume::engine
