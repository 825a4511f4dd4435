#include "server/engine/sums/loose_columns.h"

#include <algorithm>
#include <tuple>

namespace relume::engine {

LooseColumns::LooseColumns(const TransportOperator& of)
    : operator_(&of),
      most_bytes_(kLooseImages * of.sum_count() * sizeof(float)),
      bytes_(of.columns().band_count()) {}

void LooseColumns::Split::clear() {
    total_alone.clear();
    total_and_band.clear();
}

void LooseColumns::update(std::uint32_t bands_to_clear,
                          std::span<const ColumnChange> changes,
                          Split& split) {
    const std::span<const std::uint8_t> bands = operator_->columns().bands();
    const auto place = [&](const ColumnChange& change) {
        return std::tuple(bands[change.column], change.column);
    };
    const auto is_cleared = [&](const ColumnChange& change) {
        return ((bands_to_clear >> bands[change.column]) & 1U) != 0;
    };
    split.clear();
    next_.clear();
    auto loose = columns_.cbegin();
    const auto pass_loose = [&] {
        if (is_cleared(*loose)) {
            take_back(*loose, split);
        } else {
            next_.push_back(*loose);
        }
        ++loose;
    };
    for (const ColumnChange& changed : changes) {
        while (loose != columns_.cend() && place(*loose) < place(changed)) {
            pass_loose();
        }
        if (loose != columns_.cend() && loose->column == changed.column) {
            change_again(*loose, changed, is_cleared(changed), split);
            ++loose;
        } else {
            change(changed, split);
        }
    }
    while (loose != columns_.cend()) {
        pass_loose();
    }
    columns_.swap(next_);
}

void LooseColumns::take_back(const ColumnChange& loose, Split& split) {
    // What the band's image held of the column goes with that image.
    split.total_alone.push_back({.column = loose.column, .from = loose.to, .to = loose.from});
    bytes_of_band(loose) -= operator_->columns().bytes(loose.column);
}

void LooseColumns::change(const ColumnChange& change, Split& split) {
    if (bytes_of_band(change) > most_bytes_) {
        split.total_and_band.push_back(change);
        return;
    }
    split.total_alone.push_back(change);
    next_.push_back(change);
    bytes_of_band(change) += operator_->columns().bytes(change.column);
}

void LooseColumns::change_again(const ColumnChange& loose,
                                const ColumnChange& change,
                                bool band_is_cleared,
                                Split& split) {
    ColumnChange left = {.column = change.column, .from = loose.from, .to = change.to};
    ColumnChange added = {.column = change.column, .from = loose.to, .to = change.to};
    if (band_is_cleared) {
        left.from = {};
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            added.to[c] += loose.from[c];
        }
    }
    split.total_alone.push_back(added);
    if (left.is_nothing()) {
        bytes_of_band(left) -= operator_->columns().bytes(left.column);
    } else {
        next_.push_back(left);
    }
}

std::uint64_t& LooseColumns::bytes_of_band(const ColumnChange& of) {
    return bytes_[operator_->columns().bands()[of.column]];
}

void LooseColumns::clear(std::uint32_t band) {
    const auto of_band = changes_of_band(columns_, operator_->columns().bands(), band);
    const auto first = columns_.begin() + (of_band.data() - columns_.data());
    columns_.erase(first, first + static_cast<std::ptrdiff_t>(of_band.size()));
    bytes_[band] = 0;
}

void LooseColumns::clear() {
    columns_.clear();
    std::fill(bytes_.begin(), bytes_.end(), 0);
}

}  // namespace relume::engine
