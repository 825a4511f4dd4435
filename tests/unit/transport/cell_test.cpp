#include "protocol/transport/cell.h"

#include "protocol/transport/cell_cost.h"
#include "protocol/transport/error.h"
#include "protocol/transport/quantise.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

namespace relume::transport {
namespace {

QuantisedCell cell_of(int nonzeros, std::int32_t value) {
    QuantisedCell cell{};
    for (int i = 0; i < nonzeros; ++i) {
        cell[static_cast<std::size_t>(i * 255 / std::max(1, nonzeros - 1))] = value;
    }
    return cell;
}

TEST(Cell, TakesAnEncodingThatFits) {
    struct Case {
        int nonzeros;
        std::int32_t value;
        CellTag tag;
        std::size_t bytes;
    };
    const Case cases[] = {
        {0, 0, CellTag::empty, 0},
        {1, -128, CellTag::strips8, 4},
        {31, 1, CellTag::strips8, 94},
        {256, 127, CellTag::dense8, 256},
        {1, 128, CellTag::split_strips8, 8},
        {256, -32768, CellTag::dense16, 512},
        {256, 32767, CellTag::dense16, 512},
        {1, 65536 + 256 + 1, CellTag::split3_strips8, 12},
        {1, 1 << 24, CellTag::dense32f, 1024},
    };
    for (const Case& expected : cases) {
        std::vector<std::uint8_t> bytes;
        EXPECT_EQ(append_cell(cell_of(expected.nonzeros, expected.value), bytes), expected.tag);
        EXPECT_EQ(bytes.size(), expected.bytes);
    }
}

// Whatever the constants of the model are.
RC_GTEST_PROP(Cell, NoEncodingThatFitsCostsLess, ()) {
    const auto nonzeros = *rc::gen::inRange<int>(0, 257);
    const auto value = *rc::gen::element(1, 127, 200, 256, 32767, 40000);
    QuantisedCell cell = cell_of(nonzeros, 1);
    cell[0] = nonzeros > 0 ? value : 0;
    const CellShape shape = CellShape::of(cell);
    std::vector<std::uint8_t> bytes;
    const CellTag chosen = append_cell(cell, bytes);
    RC_ASSERT(shape.fits(chosen));
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        const auto tag = static_cast<CellTag>(i);
        RC_ASSERT(!shape.fits(tag) || shape.cost(chosen) <= shape.cost(tag));
    }
}

TEST(Cell, MatchesTheWorkedExample) {
    QuantisedCell cell{};
    cell[5] = -2;
    cell[200] = 7;
    std::vector<std::uint8_t> bytes;
    EXPECT_EQ(append_cell(cell, bytes), CellTag::strips8);
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0x02, 0x00, 0x20, 0x19, 0x01, 0xfe, 0x07}));
    cell[200] = 263;
    bytes.clear();
    EXPECT_EQ(append_cell(cell, bytes), CellTag::split_strips8);
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0x01, 0x19, 0x01, 0x01, 0x02, 0x00, 0x20, 0x19,
                                                0x01, 0xfe, 0x07}));
}

// In every encoding that fits.
RC_GTEST_PROP(Cell, ComesBackFromItsBytes, ()) {
    const int range = *rc::gen::element(1, 127, 128, 32767, 32768, 8000000, 1 << 24);
    const int zeros_of_8 = *rc::gen::inRange(0, 9);
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    std::uniform_int_distribution<int> value(-range, range);
    std::uniform_int_distribution<int> eighth(0, 7);
    QuantisedCell cell{};
    for (std::int32_t& q : cell) {
        q = eighth(random) < zeros_of_8 ? 0 : value(random);
    }
    const CellShape shape = CellShape::of(cell);
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        const auto tag = static_cast<CellTag>(i);
        if (!shape.fits(tag)) {
            continue;
        }
        std::vector<std::uint8_t> bytes;
        append_cell_as(tag, cell, bytes);
        RC_ASSERT(shape.bytes(tag) == bytes.size());
        RC_ASSERT(validated_cell_bytes(static_cast<std::uint8_t>(tag), bytes) == bytes.size());
        RC_ASSERT(cell_bytes(tag, bytes.data()) == bytes.size());
        DecodedCell decoded;
        RC_ASSERT(decode_cell(tag, bytes.data(), decoded) == bytes.data() + bytes.size());
        for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
            RC_ASSERT(decoded[slot] == static_cast<float>(cell[slot]));
        }
        RC_ASSERT(cell_nonzeros(tag, bytes.data()) == shape.all.nonzeros);
    }
}

// Few large values among many small ones, as the coefficients of a block are.
TEST(Cell, SplitsWhereFewValuesAreWide) {
    for (const int nonzeros : {20, 100, 256}) {
        QuantisedCell cell = cell_of(nonzeros, -3);
        cell[0] = 2000;
        cell[255] = -32768 + 128;
        std::vector<std::uint8_t> bytes;
        EXPECT_EQ(upper_parts(append_cell(cell, bytes)), 1U);
    }
}

RC_GTEST_PROP(Cell, ValidationNeverReadsBeyondTheBytes, ()) {
    const auto bytes = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
    const auto tag = *rc::gen::inRange<int>(0, 16);
    try {
        RC_ASSERT(validated_cell_bytes(static_cast<std::uint8_t>(tag), bytes) <= bytes.size());
    } catch (const TransportError&) {
        RC_SUCCEED("refused");
    }
}

TEST(Cell, RefusesWhatTheFormatForbids) {
    const std::vector<std::uint8_t> zeros(2048, 0);
    const auto refuses = [](int tag, const std::vector<std::uint8_t>& bytes) {
        EXPECT_THROW(validated_cell_bytes(static_cast<std::uint8_t>(tag), bytes),
                     TransportError);
    };
    refuses(kCellTagCount, zeros);
    {
        SCOPED_TRACE("split without a high part");
        refuses(5, zeros);
    }
    {
        SCOPED_TRACE("split without low parts, or without the upper of two");
        refuses(6, {1, 0, 1, 1});
        refuses(8, {1, 0, 1, 1, 0, 1, 0, 1, 1});
    }
    {
        SCOPED_TRACE("strips: none, not ascending, beyond the block, empty, values missing");
        refuses(2, zeros);
        refuses(2, {2, 9, 1, 9, 1, 1, 1});
        refuses(2, {1, 32, 1, 1});
        refuses(2, {1, 4, 0});
        refuses(2, {1, 4, 3, 1});
        refuses(2, {3, 4, 3});
    }
    EXPECT_THROW(validated_cell_bytes(1, std::span(zeros).first(255)), TransportError);
    std::vector<std::uint8_t> nan(1024, 0xff);
    EXPECT_THROW(validated_cell_bytes(4, nan), TransportError);
}

TEST(Quantise, IsNeverOffByMoreThanTheDeadZone) {
    constexpr float kStep = 0.25F;
    std::array<float, kBlockSize> values{};
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        values[i] = (static_cast<float>(i) - 100.3F) * 0.037F;
    }
    QuantisedCell cell;
    quantise_cell(values, kStep, cell);
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        const float error = std::abs(static_cast<float>(cell[i]) * kStep - values[i]);
        EXPECT_LE(error, (std::abs(values[i]) < kDeadZone * kStep ? kDeadZone : 0.5F) * kStep *
                             1.0001F);
    }
}

TEST(Quantise, DropsWhatIsInTheDeadZoneAndSaturates) {
    EXPECT_EQ(quantised(1.599F), 0);
    EXPECT_EQ(quantised(-1.599F), 0);
    EXPECT_EQ(quantised(1.601F), 2);
    EXPECT_EQ(quantised(-1.601F), -2);
    EXPECT_EQ(quantised(-1e20F), -(1 << 30));
}

}  // namespace
}  // namespace relume::transport
