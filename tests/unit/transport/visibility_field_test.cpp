// visibility.bin: what is written is read, and nothing else is taken.
#include "protocol/transport/visibility_field.h"

#include "protocol/transport/error.h"
#include "tests/unit/transport/broken_bytes.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <random>

namespace relume::transport {
namespace {

using Bits = std::vector<std::uint64_t>;

// Runs of open texels, as points see them; bits beyond the last texel are zero.
Bits random_bits(std::uint32_t n, std::size_t points, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::size_t words = words_of_visibility(n);
    Bits bits(points * words);
    for (std::size_t point = 0; point < points; ++point) {
        bool open = false;
        for (std::size_t texel = 0; texel < std::size_t{6} * n * n; ++texel) {
            open = random() % 16 == 0 ? !open : open;
            bits[point * words + texel / 64] |= std::uint64_t{open} << (texel % 64);
        }
    }
    return bits;
}

// Three blocks, of 5, no and 2 points.
VisibilityFieldBuilder small_field(std::uint32_t n = 8) {
    VisibilityFieldBuilder builder(n, 3);
    builder.set_block(2, random_bits(n, 2, 2));
    builder.set_block(0, random_bits(n, 5, 0));
    return builder;
}

// Opens and reads every block.
std::string refusal(std::span<const std::byte> bytes) {
    try {
        const VisibilityField field(bytes, "visibility.bin");
        Bits bits;
        for (std::uint32_t block = 0; block < field.block_count(); ++block) {
            field.read(block, bits);
        }
        return "";
    } catch (const TransportError& error) {
        return error.what();
    }
}

class Visibility : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Visibility, WhatIsWrittenIsRead) {
    const std::uint32_t n = GetParam();
    const auto bytes = small_field(n).bytes();
    const VisibilityField field(bytes, "visibility.bin");
    EXPECT_EQ(field.face_resolution(), n);
    EXPECT_EQ(field.block_count(), 3U);
    EXPECT_EQ(field.point_count(), 7U);
    const std::uint32_t counts[] = {5, 0, 2};
    Bits bits{1, 2, 3};
    for (const std::uint32_t block : {2U, 1U, 0U}) {
        EXPECT_EQ(field.point_count(block), counts[block]);
        field.read(block, bits);
        EXPECT_EQ(bits, random_bits(n, counts[block], block));
    }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, Visibility, testing::Values(4, 8, 64, 256));

TEST(VisibilityField, ATexelIsABit) {
    Bits bits(words_of_visibility(8));
    bits[2] = std::uint64_t{1} << 7;
    for (std::size_t texel = 0; texel < 6 * 8 * 8; ++texel) {
        EXPECT_EQ(is_open(bits, texel), texel == 2 * 64 + 7);
    }
}

TEST(VisibilityField, HeadIsThatOfTheSpecification) {
    VisibilityFieldBuilder builder(4, 2);
    builder.set_block(1, Bits{0xfedcba9876543210ULL, 0x89abcdefULL});
    const auto bytes = builder.bytes();
    struct {
        char magic[8];
        std::uint32_t version, blocks;
        std::uint64_t points;
        std::uint32_t n, point_bytes;
        std::uint64_t first_offset;
        std::uint32_t first_bytes, first_points;
        std::uint64_t second_offset;
        std::uint32_t second_bytes, second_points;
    } head;
    static_assert(sizeof(head) == 64);
    ASSERT_GT(bytes.size(), sizeof(head));
    std::memcpy(&head, bytes.data(), sizeof(head));
    EXPECT_EQ(std::string(head.magic, 8), "RELUMEVF");
    EXPECT_EQ(head.version, 1U);
    EXPECT_EQ(head.blocks, 2U);
    EXPECT_EQ(head.points, 1U);
    EXPECT_EQ(head.n, 4U);
    EXPECT_EQ(head.point_bytes, 16U);
    EXPECT_EQ(head.first_offset, 64U);
    EXPECT_EQ(head.first_bytes, 0U);
    EXPECT_EQ(head.first_points, 0U);
    EXPECT_EQ(head.second_offset, 64U);
    EXPECT_EQ(head.second_bytes, bytes.size() - 64);
    EXPECT_EQ(head.second_points, 1U);
}

TEST(VisibilityField, ThreadsAndTheirOrderChangeNothing) {
    VisibilityFieldBuilder builder(16, 40);
    tbb::parallel_for(0U, 40U, [&](std::uint32_t block) {
        builder.set_block(block, random_bits(16, block % 7, block));
    });
    VisibilityFieldBuilder one_by_one(16, 40);
    for (std::uint32_t block = 40; block-- > 0;) {
        one_by_one.set_block(block, random_bits(16, block % 7, block));
    }
    EXPECT_EQ(builder.bytes(), one_by_one.bytes());
}

TEST(VisibilityField, EveryWrongNumberOfTheHeadIsNamed) {
    const auto bytes = small_field().bytes();
    ASSERT_EQ(refusal(bytes), "");
    const auto with = [&](std::size_t offset, std::uint32_t value) {
        return refusal(test::with_number(bytes, offset, value));
    };
    test::expect_refusal(with(0, 1), "visibility.bin: magic");
    test::expect_refusal(with(8, 2), "version: found 2, expected 1");
    test::expect_refusal(with(12, 2), "block 0: offset");
    test::expect_refusal(with(12, 0xffffffffU), "index of 4294967295 blocks");
    test::expect_refusal(with(16, 8), "count of points: found 7 in the blocks, expected 8");
    test::expect_refusal(with(24, 7), "face resolution: found 7");
    test::expect_refusal(with(24, 512), "face resolution: found 512");
    test::expect_refusal(with(24, 16), "bytes of a point: found 48, expected 192");
    test::expect_refusal(with(28, 0), "frame");
    test::expect_refusal(with(28, 96), "frame");
    constexpr std::size_t kIndex = 32;
    test::expect_refusal(with(kIndex, 81), "block 0: offset: found 81, expected 80");
    test::expect_refusal(with(kIndex + 8, 0xffffffffU), "block 0: length");
    test::expect_refusal(with(kIndex + 12, 4), "block 0: frame");
    test::expect_refusal(with(kIndex + 12, 65536), "block 0: count of points: found 65536");
    test::expect_refusal(with(kIndex + 12, 0), "block 0: length");
    test::expect_refusal(with(kIndex + 16 + 12, 1), "block 1: frame");
    test::expect_refusal(with(kIndex + 16 + 8, 1), "block 1: length");
}

TEST(VisibilityField, ABlockBeyondItsMemoryIsRefused) {
    const auto bytes = small_field().bytes();
    const auto large = test::with_number(bytes, 28, 1U << 30);
    test::expect_refusal(refusal(large), "of together 268435456 bytes");
}

TEST(VisibilityField, AnotherLengthIsRefused) {
    auto bytes = small_field().bytes();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(refusal(std::span(bytes).first(size)), "") << size;
    }
    bytes.push_back(std::byte{0});
    test::expect_refusal(refusal(bytes), "length");
}

TEST(VisibilityField, BitsBeyondTheLastTexelAreRefused) {
    VisibilityFieldBuilder builder(4, 1);
    builder.set_block(0, Bits{0, 0, 0, std::uint64_t{1} << 32});
    test::expect_refusal(refusal(builder.bytes()), "point 1: found a bit beyond");
}

// Whatever the bytes are, they are refused or give bits of the stated shape.
TEST(VisibilityField, BrokenBytesNeverGiveMoreThanTheyState) {
    test::for_each_broken(small_field().bytes(), 4000, [](std::span<const std::byte> bytes) {
        try {
            const VisibilityField field(bytes, "visibility.bin");
            Bits bits;
            for (std::uint32_t block = 0; block < field.block_count(); ++block) {
                field.read(block, bits);
                ASSERT_EQ(bits.size(), field.point_count(block) * field.words_per_point());
            }
        } catch (const TransportError& error) {
            test::expect_refusal(error.what(), "visibility.bin: ");
        }
    });
}

TEST(VisibilityField, TooManyPointsAreNotWritten) {
    VisibilityFieldBuilder builder(8, 1);
    EXPECT_THROW(builder.set_block(0, Bits(65536 * words_of_visibility(8))), TransportError);
    EXPECT_THROW(builder.set_block(0, Bits(words_of_visibility(8) + 1)), TransportError);
    VisibilityFieldBuilder fine(256, 1);
    EXPECT_THROW(fine.set_block(0, Bits(5500 * words_of_visibility(256))), TransportError);
}

}  // namespace
}  // namespace relume::transport
