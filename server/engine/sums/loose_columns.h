// Columns that the running total holds and the images of their bands do not.
#pragma once

#include "server/engine/columns/column_change.h"
#include "server/engine/operators/transport_operator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A drag changes few columns an image and soon takes most of them back. To write them into an
// image per band as well takes longer than to take them away again column by column; so they
// stay loose. Not thread-safe.
class LooseColumns {
  public:
    explicit LooseColumns(const TransportOperator& of);

    // What an update comes to, ordered by band and index.
    struct Split {
        std::vector<ColumnChange> total_alone;
        std::vector<ColumnChange> total_and_band;

        void clear();
    };
    // Bands of the mask begin anew, whose images the caller takes away; the changes, ordered by
    // band and index, are relative to that. What is loose in these bands is taken back, in one
    // with what comes new of the same column. Columns of a band are loose until they have more
    // bytes than kLooseImages images of sums; what else changes goes into its band's image too.
    static constexpr std::uint64_t kLooseImages = 4;
    void update(std::uint32_t bands_to_clear,
                std::span<const ColumnChange> changes,
                Split& split);

    // From what the band's image holds to what the total holds, ordered by band and index.
    [[nodiscard]] std::span<const ColumnChange> columns() const { return columns_; }
    // The band's image has been made to hold what the total holds.
    void clear(std::uint32_t band);
    void clear();

  private:
    void take_back(const ColumnChange& loose, Split& split);
    void change(const ColumnChange& change, Split& split);
    void change_again(const ColumnChange& loose,
                      const ColumnChange& change,
                      bool band_is_cleared,
                      Split& split);
    [[nodiscard]] std::uint64_t& bytes_of_band(const ColumnChange& of);

    const TransportOperator* operator_;
    std::uint64_t most_bytes_;  // of a band
    std::vector<ColumnChange> columns_;
    std::vector<ColumnChange> next_;    // what columns_ becomes, while it is worked out
    std::vector<std::uint64_t> bytes_;  // [bands], of what is loose
};

}  // namespace relume::engine
