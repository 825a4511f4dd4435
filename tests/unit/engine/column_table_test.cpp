#include "server/engine/columns/column_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace relume::engine {
namespace {

constexpr std::array<std::uint32_t, 4> kBytes{4, 25, 0, 100};
// Of red, green and blue.
constexpr std::array<float, 12> kEnergies{16, 1, 0, 25, 100, 0, 0, 0, 0, 1, 4, 9};

ColumnTable::Columns four_columns() {
    return {.bands = {.of_coefficient = {0, 1, 0, 1}, .octaves = {0, 2}},
            .energies = kEnergies,
            .bytes = kBytes,
            .stating = {},
            .choosing = {}};
}

std::vector<float> weights_of(const ColumnTable& table, relighting::Priority priority) {
    const auto weights = table.weights(priority);
    return {weights.begin(), weights.end()};
}

TEST(ColumnTable, WeighsAChangeByWhatThePriorityAsksFor) {
    const ColumnTable table(four_columns());
    // Red of the four columns, then green, then blue.
    EXPECT_EQ(weights_of(table, relighting::Priority::none), std::vector<float>(12, 1));
    EXPECT_EQ(weights_of(table, relighting::Priority::area),
              (std::vector<float>{1, .25F, 1, .25F, 1, .25F, 1, .25F, 1, .25F, 1, .25F}));
    EXPECT_EQ(weights_of(table, relighting::Priority::transport),
              (std::vector<float>{4, 5, 0, 1, 1, 10, 0, 2, 0, 0, 0, 3}));
    EXPECT_EQ(weights_of(table, relighting::Priority::benefit),
              (std::vector<float>{2, 1, 0, .1F, .5F, 2, 0, .2F, 0, 0, 0, .3F}));
}

TEST(ColumnTable, OrdersColumnsByBandAndThenByIndex) {
    const ColumnTable table(four_columns());
    const auto by_band = table.by_band();
    EXPECT_EQ(std::vector<std::uint32_t>(by_band.begin(), by_band.end()),
              (std::vector<std::uint32_t>{0, 2, 1, 3}));
    const auto of_band = table.of_band(1);
    EXPECT_EQ(std::vector<std::uint32_t>(of_band.begin(), of_band.end()),
              (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(table.all_bands(), 3U);
    EXPECT_EQ(table.total_bytes(), 129U);
}

TEST(ColumnTable, RefusesCountsThatDoNotAgreeAndTooManyBands) {
    ColumnTable::Columns columns = four_columns();
    columns.bytes = std::span(kBytes).first(3);
    EXPECT_THROW(ColumnTable{columns}, std::invalid_argument);
    columns = four_columns();
    columns.energies = std::span(kEnergies).first(11);
    EXPECT_THROW(ColumnTable{columns}, std::invalid_argument);
    columns = four_columns();
    columns.bands.octaves.resize(basis::kMaxBands + 1);
    EXPECT_THROW(ColumnTable{columns}, std::invalid_argument);
}

}  // namespace
}  // namespace relume::engine
