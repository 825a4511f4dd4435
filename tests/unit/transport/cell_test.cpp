#include "protocol/transport/cell.h"

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

TEST(Cell, TakesTheCheapestEncoding) {
    struct Case {
        int nonzeros;
        std::int32_t value;
        CellTag tag;
        std::size_t bytes;
    };
    const Case cases[] = {
        {0, 0, CellTag::empty, 0},
        {1, -128, CellTag::sparse8, 3},
        {31, 1, CellTag::sparse8, 63},
        {32, 1, CellTag::bitmap8, 64},
        {223, 1, CellTag::bitmap8, 255},
        {224, 1, CellTag::dense8, 256},
        {256, 127, CellTag::dense8, 256},
        {1, 128, CellTag::bitmap16, 34},
        {239, -32768, CellTag::bitmap16, 510},
        {240, 32767, CellTag::dense16, 512},
        {1, 32768, CellTag::dense32f, 1024},
    };
    for (const Case& expected : cases) {
        std::vector<std::uint8_t> bytes;
        EXPECT_EQ(append_cell(cell_of(expected.nonzeros, expected.value), bytes), expected.tag);
        EXPECT_EQ(bytes.size(), expected.bytes);
    }
}

TEST(Cell, MatchesTheWorkedExample) {
    QuantisedCell cell{};
    cell[5] = -2;
    cell[200] = 7;
    std::vector<std::uint8_t> bytes;
    EXPECT_EQ(append_cell(cell, bytes), CellTag::sparse8);
    EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0x02, 0x05, 0xc8, 0xfe, 0x07}));
}

RC_GTEST_PROP(Cell, ComesBackFromItsBytes, ()) {
    const int range = *rc::gen::element(1, 127, 128, 32767, 32768, 1 << 24);
    const int zeros_of_8 = *rc::gen::inRange(0, 9);
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    std::uniform_int_distribution<int> value(-range, range);
    std::uniform_int_distribution<int> eighth(0, 7);
    QuantisedCell cell{};
    for (std::int32_t& q : cell) {
        q = eighth(random) < zeros_of_8 ? 0 : value(random);
    }
    std::vector<std::uint8_t> bytes;
    const CellTag tag = append_cell(cell, bytes);
    RC_ASSERT(validated_cell_bytes(static_cast<std::uint8_t>(tag), bytes) == bytes.size());
    RC_ASSERT(cell_bytes(tag, bytes.data()) == bytes.size());
    DecodedCell decoded;
    RC_ASSERT(decode_cell(tag, bytes.data(), decoded) == bytes.data() + bytes.size());
    std::uint32_t nonzeros = 0;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        RC_ASSERT(decoded[slot] == static_cast<float>(cell[slot]));
        nonzeros += cell[slot] != 0 ? 1U : 0U;
    }
    RC_ASSERT(cell_nonzeros(tag, bytes.data()) == nonzeros);
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
    EXPECT_THROW(validated_cell_bytes(7, zeros), TransportError);
    EXPECT_THROW(validated_cell_bytes(2, zeros), TransportError) << "bitmap without a bit";
    EXPECT_THROW(validated_cell_bytes(3, zeros), TransportError) << "sparse without a value";
    EXPECT_THROW(validated_cell_bytes(3, std::vector<std::uint8_t>{2, 9, 9, 1, 1}),
                 TransportError)
        << "slots not ascending";
    EXPECT_THROW(validated_cell_bytes(1, std::span(zeros).first(255)), TransportError);
    std::vector<std::uint8_t> nan(1024, 0xff);
    EXPECT_THROW(validated_cell_bytes(6, nan), TransportError);
}

TEST(Quantise, IsRightOnAverageAndNeverOffByAStep) {
    constexpr float kStep = 0.25F;
    for (const float value : {0.13F, -0.3F, 1.1F, 7.77F}) {
        std::array<float, kBlockSize> values{};
        values.fill(value);
        double sum = 0;
        constexpr int kColumns = 200;
        for (int column = 0; column < kColumns; ++column) {
            QuantisedCell quantised;
            quantise_cell(values, kStep, 256, static_cast<std::uint64_t>(column), quantised);
            for (const std::int32_t q : quantised) {
                ASSERT_LT(std::abs(static_cast<float>(q) * kStep - value), kStep * 1.0001F);
                sum += static_cast<double>(q);
            }
        }
        // Standard error of the mean is at most step/2/√51200.
        EXPECT_NEAR(sum * kStep / (kColumns * kBlockSize), value, 6 * kStep / 2 / 226.0);
    }
}

TEST(Quantise, DropsWhatIsBelowHalfAStep) {
    std::array<float, kBlockSize> values{};
    values.fill(0.49F);
    QuantisedCell quantised;
    quantise_cell(values, 1, 0, 0, quantised);
    EXPECT_EQ(quantised, QuantisedCell{});
}

}  // namespace
}  // namespace relume::transport
