#include "server/engine/sums/loose_columns.h"

#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace relume::engine {
namespace {

using Amounts = std::array<float, transport::kColours>;

const served::Scene& scene() {
    static const TinyScene tiny;
    return *tiny.scene();
}

// Whole numbers, so that no sum rounds.
Amounts random_amounts() {
    Amounts amounts;
    for (float& amount : amounts) {
        amount = static_cast<float>(*rc::gen::inRange(-3, 4));
    }
    return amounts;
}

// What total and bands' images hold of every column, carried along from the splits alone; and
// what they should hold.
struct Books {
    std::vector<Amounts> shown = std::vector<Amounts>(scene().columns().count());
    std::vector<Amounts> total = shown;
    std::vector<Amounts> held = shown;

    void clear(std::uint32_t bands_to_clear) {
        for (std::size_t j = 0; j < shown.size(); ++j) {
            if (((bands_to_clear >> scene().columns().bands()[j]) & 1U) != 0) {
                add(total[j], held[j], -1);
                held[j] = {};
                shown[j] = {};
            }
        }
    }
    void apply(const LooseColumns::Split& split) {
        for (const ColumnChange& change : split.total_alone) {
            add_change(total, change);
        }
        for (const ColumnChange& change : split.total_and_band) {
            add_change(total, change);
            add_change(held, change);
        }
    }

  private:
    static void add(Amounts& to, const Amounts& amounts, float sign) {
        for (std::size_t c = 0; c < to.size(); ++c) {
            to[c] += sign * amounts[c];
        }
    }
    static void add_change(std::vector<Amounts>& to, const ColumnChange& change) {
        add(to[change.column], change.to, 1);
        add(to[change.column], change.from, -1);
    }
};

// A part of the columns in the order of bands, from what is shown to anything else.
std::vector<ColumnChange> random_changes(const Books& books) {
    const int one_in = *rc::gen::element(1, 2, 20, 200);
    std::vector<ColumnChange> changes;
    for (const std::uint32_t j : scene().columns().by_band()) {
        if (*rc::gen::inRange(0, one_in) == 0) {
            const ColumnChange change{
                .column = j, .from = books.shown[j], .to = random_amounts()};
            if (!change.is_nothing()) {
                changes.push_back(change);
            }
        }
    }
    return changes;
}

bool is_ordered(std::span<const ColumnChange> changes) {
    return std::is_sorted(changes.begin(), changes.end(),
                          [](const ColumnChange& a, const ColumnChange& b) {
                              return std::tuple(scene().columns().bands()[a.column], a.column) <
                                     std::tuple(scene().columns().bands()[b.column], b.column);
                          });
}

// Whatever is changed and cleared: what goes to the total adds up to what is shown, what goes
// to the bands' images to the rest of what is not loose, and no more is loose than is allowed.
RC_GTEST_PROP(LooseColumns, AreWhatTheTotalHoldsAndBandsDoNot, ()) {
    Books books;
    LooseColumns loose(scene().stored_operator());
    LooseColumns::Split split;
    for (int round = *rc::gen::inRange(1, 6); round > 0; --round) {
        const auto bands_to_clear =
            *rc::gen::inRange<std::uint32_t>(0, 1U << scene().columns().band_count());
        books.clear(bands_to_clear);
        const std::vector<ColumnChange> changes = random_changes(books);
        loose.update(bands_to_clear, changes, split);
        books.apply(split);
        for (const ColumnChange& change : changes) {
            books.shown[change.column] = change.to;
        }
        RC_ASSERT(books.total == books.shown);
        std::vector<Amounts> not_loose = books.shown;
        std::vector<std::uint64_t> bytes(scene().columns().band_count());
        std::uint64_t largest = 0;
        for (const ColumnChange& column : loose.columns()) {
            RC_ASSERT(!column.is_nothing());
            RC_ASSERT(column.to == books.shown[column.column]);
            not_loose[column.column] = column.from;
            const std::uint64_t size = scene().columns().bytes(column.column);
            bytes[scene().columns().bands()[column.column]] += size;
            largest = std::max(largest, size);
        }
        RC_ASSERT(books.held == not_loose);
        RC_ASSERT(*std::max_element(bytes.begin(), bytes.end()) <=
                  LooseColumns::kLooseImages * scene().stored_operator().sum_count() *
                          sizeof(float) +
                      largest);
        RC_ASSERT(is_ordered(loose.columns()));
        RC_ASSERT(is_ordered(split.total_alone));
        RC_ASSERT(is_ordered(split.total_and_band));
    }
}

// Of every band the first columns are loose, until they have more bytes than a few images of
// sums; the others go into the image of their band as well.
TEST(LooseColumns, GoToTheirBandWhenThereAreMany) {
    const ColumnTable& table = scene().columns();
    const std::uint64_t most_bytes =
        LooseColumns::kLooseImages * scene().stored_operator().sum_count() * sizeof(float);
    std::vector<ColumnChange> changes;
    std::vector<std::uint32_t> loose_alone;
    std::vector<std::uint32_t> with_band;
    for (std::uint32_t band = 0; band < table.band_count(); ++band) {
        std::uint64_t bytes = 0;
        for (const std::uint32_t j : table.of_band(band)) {
            changes.push_back({.column = j, .to = {1, 1, 1}});
            (bytes > most_bytes ? with_band : loose_alone).push_back(j);
            bytes += bytes > most_bytes ? 0 : table.bytes(j);
        }
    }
    ASSERT_FALSE(with_band.empty()) << "the scene has a band of more bytes than may be loose";
    LooseColumns loose(scene().stored_operator());
    LooseColumns::Split split;
    loose.update(0, changes, split);
    const auto expect_columns = [](std::span<const ColumnChange> found,
                                   const std::vector<std::uint32_t>& expected) {
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(found[i].column, expected[i]);
            EXPECT_TRUE(found[i].from == Amounts{});
            EXPECT_TRUE((found[i].to == Amounts{1, 1, 1}));
        }
    };
    expect_columns(split.total_alone, loose_alone);
    expect_columns(split.total_and_band, with_band);
    expect_columns(loose.columns(), loose_alone);
    loose.clear();
    loose.update(0, std::span(changes).first(5), split);
    expect_columns(split.total_alone, {loose_alone.begin(), loose_alone.begin() + 5});
    EXPECT_TRUE(split.total_and_band.empty());
}

}  // namespace
}  // namespace relume::engine
