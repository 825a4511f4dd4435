// *Loose* columns: those of which the total (band_sums.h) holds more, or less, than the image
// of their band does.
#pragma once

#include "server/engine/columns/column_change.h"
#include "server/engine/operators/transport_operator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A drag changes few columns an image and soon takes most of them back. To write every change
// into the image of its band as well takes longer than to take the columns out of the total
// again one by one. So changes go to the total alone, and this class keeps a list of them. Not
// thread-safe.
class LooseColumns {
  public:
    explicit LooseColumns(const TransportOperator& of);

    // The additions that an update of BandSums comes to, ordered by band and index.
    struct Split {
        std::vector<ColumnChange> total_alone;
        std::vector<ColumnChange> total_and_band;

        void clear();
    };
    // Works out the additions of an update. The bands of the mask begin anew: the caller takes
    // their images out of the total, and `split` takes out what is loose in them. The changes
    // are ordered by band and index, and their `from` is what is shown after that. Where a
    // column is both taken out and changed, the two become one addition. A band's changed
    // columns are loose until they have more bytes than kLooseImages sets of sums; beyond that
    // a change goes into the image of its band too.
    static constexpr std::uint64_t kLooseImages = 4;
    void update(std::uint32_t bands_to_clear,
                std::span<const ColumnChange> changes,
                Split& split);

    // The loose columns: `from` is how much the band's image holds, `to` how much the total
    // holds. Ordered by band and index.
    [[nodiscard]] std::span<const ColumnChange> columns() const { return columns_; }
    // The image of the band, or of every band, has been made anew and holds what the total
    // holds of it.
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
