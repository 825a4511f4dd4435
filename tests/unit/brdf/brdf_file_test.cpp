#include "protocol/brdf/brdf_file.h"

#include "protocol/brdf/error.h"
#include "tests/unit/brdf/brdfs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

namespace relume::brdf {
namespace {

using Bytes = std::vector<std::byte>;

// Offsets of the first BRDF's record.
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kCountAt = 12;
constexpr std::size_t kRecordAt = 16;
constexpr std::size_t kNameAt = kRecordAt + 28;

Bytes two_brdfs() {
    return bytes_from_brdfs(std::array{random_brdf("metal", 3, 2), random_brdf("", 1, 1)});
}

void set_number(Bytes& bytes, std::size_t at, std::uint32_t value) {
    std::memcpy(&bytes[at], &value, sizeof(value));
}

void expect_refused(const Bytes& bytes, const std::string& part_of_message) {
    try {
        static_cast<void>(brdfs_from_bytes("here/brdfs.bin", bytes));
        ADD_FAILURE() << "accepted, expected: " << part_of_message;
    } catch (const BrdfError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("here/brdfs.bin: ", 0), 0U) << message;
        EXPECT_NE(message.find(part_of_message), std::string::npos) << message;
    }
}

TEST(BrdfFile, GivesBackWhatWasWritten) {
    const std::array brdfs{random_brdf("metal", 3, 2), random_brdf("", 1, 1),
                           random_brdf("a name with blanks", 16, 4)};
    const Bytes bytes = bytes_from_brdfs(brdfs);
    const auto read = brdfs_from_bytes("f", bytes);
    ASSERT_EQ(read.size(), brdfs.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].name, brdfs[i].name);
        EXPECT_EQ(read[i].terms, brdfs[i].terms);
        EXPECT_EQ(read[i].lobes, brdfs[i].lobes);
        EXPECT_EQ(read[i].g.shape(), brdfs[i].g.shape());
        EXPECT_EQ(read[i].h.shape(), brdfs[i].h.shape());
        EXPECT_TRUE(std::ranges::equal(read[i].g.values(), brdfs[i].g.values()));
        EXPECT_TRUE(std::ranges::equal(read[i].h.values(), brdfs[i].h.values()));
    }
    EXPECT_EQ(bytes_from_brdfs(read), bytes);
}

TEST(BrdfFile, MatchesTheWorkedExample) {
    const FactoredBrdf brdf{.name = "wall",
                            .terms = 1,
                            .lobes = 1,
                            .g = {{2, 1, 1}, {0.25F, 0.25F}},
                            .h = {{2, 1, 1}, {2, 2}}};
    const Bytes bytes = bytes_from_brdfs(std::array{brdf});
    const std::uint32_t expected[]{0x554c4552, 0x5242454d, 1,          1,         4, 1,
                                   1,          2,          1,          2,         1, 0x6c6c6177,
                                   0x3e800000, 0x3e800000, 0x40000000, 0x40000000};
    ASSERT_EQ(bytes.size(), sizeof(expected));
    EXPECT_EQ(std::memcmp(bytes.data(), expected, sizeof(expected)), 0);
}

TEST(BrdfFile, RefusesEveryBeginningOfAFileAndBytesAtItsEnd) {
    const Bytes bytes = two_brdfs();
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        expect_refused(
            Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)),
            "expected");
    }
    Bytes longer = bytes;
    longer.resize(bytes.size() + 4);
    expect_refused(longer, "4 bytes follow the last BRDF");
}

TEST(BrdfFile, RefusesNumbersOutOfRange) {
    constexpr std::uint32_t kHuge = 0xffffffff;
    const auto with = [](std::size_t at, std::uint32_t value) {
        Bytes bytes = two_brdfs();
        set_number(bytes, at, value);
        return bytes;
    };
    expect_refused(with(0, 0x12345678), "does not begin with RELUMEBR");
    expect_refused(with(kVersionAt, 2), "version 2, expected 1");
    expect_refused(with(kCountAt, 0), "0 BRDFs");
    expect_refused(with(kCountAt, kHuge), "BRDFs, expected 1 … 4096");
    expect_refused(with(kCountAt, 3), "bytes are left");
    expect_refused(with(kRecordAt, kHuge), "a name has");
    for (const std::uint32_t terms : {0U, 17U, kHuge}) {
        expect_refused(with(kRecordAt + 4, terms), terms == 0 ? "depth 0" : "terms");
    }
    for (const std::uint32_t lobes : {0U, 5U, kHuge}) {
        expect_refused(with(kRecordAt + 8, lobes), lobes == 0 ? "depth 0" : "lobes");
    }
    for (std::size_t field = 3; field < 7; ++field) {
        expect_refused(with(kRecordAt + 4 * field, 0), "out of range");
        expect_refused(with(kRecordAt + 4 * field, kHuge), "out of range");
    }
    // In range, but longer than the file.
    expect_refused(with(kRecordAt + 4 * 3, 512), "bytes are left");
}

TEST(BrdfFile, RefusesValuesThatAreNotFiniteAndNamesThatAreNoNames) {
    Bytes bytes = two_brdfs();
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(&bytes[kNameAt + 8], &infinite, sizeof(infinite));
    expect_refused(bytes, "finite");
    bytes = two_brdfs();
    bytes[kNameAt + 1] = std::byte{'\n'};
    expect_refused(bytes, "control character");
    bytes = two_brdfs();
    bytes[kNameAt + 6] = std::byte{1};
    expect_refused(bytes, "not zero");
}

TEST(BrdfFile, AChangedByteIsReadOrRefused) {
    std::mt19937 random(9);
    const Bytes bytes = two_brdfs();
    for (int i = 0; i < 5000; ++i) {
        Bytes changed = bytes;
        changed[random() % (i % 2 == 0 ? 60 : changed.size())] =
            static_cast<std::byte>(random() % 256);
        try {
            for (const FactoredBrdf& brdf : brdfs_from_bytes("f", changed)) {
                EXPECT_NO_THROW(require_valid(brdf));
            }
        } catch (const BrdfError&) {
        }
    }
}

TEST(BrdfFile, WritesNothingThatItWouldNotRead) {
    EXPECT_THROW(static_cast<void>(bytes_from_brdfs({})), BrdfError);
    FactoredBrdf torn = random_brdf("torn", 2, 2);
    torn.lobes = 1;
    EXPECT_THROW(static_cast<void>(bytes_from_brdfs(std::array{torn})), BrdfError);
    const std::vector<FactoredBrdf> many(kMostBrdfs + 1, factored_lambert("", Imath::V3f(1)));
    EXPECT_THROW(static_cast<void>(bytes_from_brdfs(many)), BrdfError);
}

}  // namespace
}  // namespace relume::brdf
