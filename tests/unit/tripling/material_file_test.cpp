#include "protocol/tripling/material_file.h"

#include "protocol/base/files/error.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

namespace relume::tripling {
namespace {

using Bytes = std::vector<std::byte>;

// Of the header.
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kFaceResolutionAt = 12;
constexpr std::size_t kNormalSideAt = 16;
constexpr std::size_t kReflectionSideAt = 20;
constexpr std::size_t kLobesAt = 24;
constexpr std::size_t kEnergyAt = 28;
constexpr std::size_t kNameBytesAt = 32;
constexpr std::size_t kZeroAt = 36;
constexpr std::size_t kSquaresAt = 40;
constexpr std::size_t kHeaderBytes = 48;
constexpr std::uint32_t kFaceResolution = 8;

MaterialField random_field() {
    MaterialField field;
    field.name = "satin";
    field.normals = DirectionGrid(2);
    field.reflections = DirectionGrid(1);
    field.energy_fraction = 0.75F;
    field.colours = {Imath::V3f(0.5F, 0.25F, 0), Imath::V3f(1, 1, 2)};
    unsigned seed = 0;
    for (std::size_t lobe = 0; lobe < field.colours.size(); ++lobe) {
        WaveletStore& store = field.lobes.emplace_back(kFaceResolution);
        for (std::size_t entry = 0; entry < field.entry_count(); ++entry) {
            const auto c =
                coefficients_of(kFaceResolution, random_cubemap(kFaceResolution, ++seed));
            store.append(SparseWavelets(squares_of_energy(kFaceResolution, c, 0.75), c));
        }
    }
    return field;
}

// Its only entry is 1 at every texel, and its name takes one byte.
MaterialField smallest_field() {
    MaterialField field;
    field.name = "m";
    field.colours = {Imath::V3f(1, 0.5F, 0)};
    const auto c = coefficients_of(4, std::vector<float>(96, 1.0F));
    field.lobes.emplace_back(4).append(SparseWavelets(SquareSet(4), c));
    return field;
}

// With the checksum that the bytes now have.
Bytes with_checksum(Bytes bytes) {
    const std::size_t covered = bytes.size() - sizeof(std::uint64_t);
    const std::uint64_t checksum = XXH3_64bits(bytes.data(), covered);
    std::memcpy(&bytes[covered], &checksum, sizeof(checksum));
    return bytes;
}

template <typename Number>
Bytes changed(Bytes bytes, std::size_t at, Number value) {
    std::memcpy(&bytes[at], &value, sizeof(value));
    return with_checksum(std::move(bytes));
}

void expect_refused(const Bytes& bytes, const std::string& part_of_message) {
    try {
        (void)field_from_bytes("here/a.material", bytes);
        ADD_FAILURE() << "accepted, expected: " << part_of_message;
    } catch (const MaterialFileError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("here/a.material: ", 0), 0U) << message;
        EXPECT_NE(message.find(part_of_message), std::string::npos) << message;
    }
}

TEST(MaterialFile, GivesBackWhatWasWritten) {
    const MaterialField field = random_field();
    const Bytes bytes = bytes_from_field(field);
    const MaterialField read = field_from_bytes("f", bytes);
    EXPECT_EQ(read.name, field.name);
    EXPECT_EQ(read.normals, field.normals);
    EXPECT_EQ(read.reflections, field.reflections);
    EXPECT_EQ(read.energy_fraction, field.energy_fraction);
    EXPECT_EQ(read.colours, field.colours);
    ASSERT_EQ(read.lobes.size(), field.lobes.size());
    for (std::size_t lobe = 0; lobe < read.lobes.size(); ++lobe) {
        ASSERT_EQ(read.lobes[lobe].size(), field.lobes[lobe].size());
        for (std::size_t i = 0; i < read.lobes[lobe].size(); ++i) {
            const WaveletView a = read.lobes[lobe].view(i);
            const WaveletView b = field.lobes[lobe].view(i);
            EXPECT_EQ(a.scaling, b.scaling);
            ASSERT_EQ(a.first, b.first);
            EXPECT_TRUE(std::equal(a.squares, a.squares + a.first.back(), b.squares));
            EXPECT_TRUE(std::equal(a.values, a.values + a.first.back(), b.values));
        }
    }
    EXPECT_EQ(bytes_from_field(read), bytes);
}

TEST(MaterialFile, MatchesTheWorkedExample) {
    const Bytes bytes = bytes_from_field(smallest_field());
    const std::uint32_t expected[]{
        0x554c4552, 0x464d454d, 1,          4,          1,          1,
        1,          0x3f800000, 1,          0,          0,          0,
        0x0000006d, 0x3f800000, 0x3f000000, 0,                                   // colour
        0x40800000, 0x40800000, 0x40800000, 0x40800000, 0x40800000, 0x40800000,  // scaling
        0,          0,          0};                                              // counts
    ASSERT_EQ(bytes.size(), sizeof(expected) + 8);
    EXPECT_EQ(std::memcmp(bytes.data(), expected, sizeof(expected)), 0);
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, &bytes[sizeof(expected)], sizeof(checksum));
    EXPECT_EQ(checksum, XXH3_64bits(expected, sizeof(expected)));
}

TEST(MaterialFile, RefusesEveryBeginningOfAFileAndBytesAtItsEnd) {
    const Bytes bytes = bytes_from_field(random_field());
    for (std::size_t length = 0; length < bytes.size(); length += length < 80 ? 1 : 97) {
        expect_refused({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)},
                       "length: found");
    }
    Bytes longer = bytes;
    longer.push_back(std::byte{0});
    expect_refused(longer, "length: found");
}

TEST(MaterialFile, NoticesEveryByteThatChanged) {
    const Bytes bytes = bytes_from_field(random_field());
    for (std::size_t at = 0; at < bytes.size(); at += at < 80 ? 1 : 41) {
        Bytes damaged = bytes;
        damaged[at] ^= std::byte{0x10};
        EXPECT_THROW((void)field_from_bytes("f", damaged), MaterialFileError) << at;
    }
}

TEST(MaterialFile, RefusesEveryNumberOfTheHeaderThatIsOutOfRange) {
    const Bytes bytes = bytes_from_field(random_field());
    expect_refused(changed(bytes, 0, 'r'), "RELUMEMF");
    expect_refused(changed(bytes, kVersionAt, 2U), "version: found 2");
    for (const std::uint32_t n : {0U, 2U, 12U, 512U}) {
        expect_refused(changed(bytes, kFaceResolutionAt, n), "face resolution");
    }
    for (const std::uint32_t side : {0U, 66U, ~0U}) {
        expect_refused(changed(bytes, kNormalSideAt, side), "nodes along a face of normals");
        expect_refused(changed(bytes, kReflectionSideAt, side),
                       "nodes along a face of reflections");
    }
    for (const std::uint32_t lobes : {0U, 5U, ~0U}) {
        expect_refused(changed(bytes, kLobesAt, lobes), "lobes");
    }
    for (const float energy : {0.0F, -1.0F, 1.5F, std::numeric_limits<float>::quiet_NaN()}) {
        expect_refused(changed(bytes, kEnergyAt, energy), "fraction of energy");
    }
    for (const std::uint32_t length : {0U, 256U, ~0U}) {
        expect_refused(changed(bytes, kNameBytesAt, length), "bytes of the name");
    }
    expect_refused(changed(bytes, kZeroAt, 1U), "found 1");
    expect_refused(changed(bytes, kSquaresAt, ~std::uint64_t{0}), "squares: found");
    expect_refused(changed(bytes, kSquaresAt, std::uint64_t{1} << 40), "squares: found");
    // In range, but of another file.
    expect_refused(changed(bytes, kNormalSideAt, 3U), "length: found");
    expect_refused(changed(bytes, kSquaresAt, std::uint64_t{1}), "length: found");
    expect_refused(changed(bytes, kNameBytesAt, 9U), "length: found");
}

TEST(MaterialFile, RefusesWhatKernelsCouldNotRead) {
    const MaterialField field = random_field();
    const Bytes bytes = bytes_from_field(field);
    const std::size_t entries = field.entry_count();
    constexpr std::size_t kNameAt = kHeaderBytes;
    constexpr std::size_t kColoursAt = kNameAt + 8;
    constexpr std::size_t kScalingAt = kColoursAt + 24;
    const std::size_t counts_at = kScalingAt + 24 * entries;
    const std::size_t squares_at = counts_at + 12 * entries;
    std::size_t squares = 0;
    for (std::size_t i = 0; i < entries; ++i) {
        squares += field.lobes[0].view(i).first.back();
    }
    const std::size_t values_at = squares_at + 2 * squares;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();

    expect_refused(changed(bytes, kNameAt, '\n'), "control character");
    expect_refused(changed(bytes, kNameAt + 6, 'x'), "bytes after the name");
    expect_refused(changed(bytes, kColoursAt, -0.5F), "a colour: found -0.5");
    expect_refused(changed(bytes, kColoursAt, kInfinity), "a colour");
    expect_refused(changed(bytes, kScalingAt, kInfinity), "a scaling coefficient");
    expect_refused(changed(bytes, values_at, std::nanf("")), "a coefficient");
    expect_refused(changed(bytes, counts_at, std::uint16_t{0xffff}), "squares");
    expect_refused(changed(bytes, counts_at, std::uint16_t{0}), "a square");
    // The first square of a face is its root. 21 squares of a face of 8×8 texels.
    expect_refused(changed(bytes, squares_at, std::uint16_t{21}), "a square: found 21");
    expect_refused(changed(bytes, squares_at + 2, std::uint16_t{0}), "a square: found 0");
    expect_refused(changed(bytes, squares_at, std::uint16_t{1}), "expected all squares above");
}

TEST(MaterialFile, RefusesToWriteWhatItWouldNotRead) {
    const auto expect_not_written = [](const std::function<void(MaterialField&)>& spoil) {
        MaterialField field = random_field();
        spoil(field);
        EXPECT_THROW((void)bytes_from_field(field), MaterialFileError);
    };
    expect_not_written([](MaterialField& field) { field.name.clear(); });
    expect_not_written([](MaterialField& field) { field.name.assign(256, 'a'); });
    expect_not_written([](MaterialField& field) { field.name = "a\tb"; });
    expect_not_written([](MaterialField& field) { field.lobes.clear(); });
    expect_not_written([](MaterialField& field) { field.colours.pop_back(); });
    expect_not_written([](MaterialField& field) { field.colours[0].y = -1; });
    expect_not_written([](MaterialField& field) { field.energy_fraction = 0; });
    expect_not_written([](MaterialField& field) { field.normals = DirectionGrid(3); });
    expect_not_written([](MaterialField& field) { field.lobes[1] = WaveletStore(4); });
    expect_not_written([](MaterialField& field) {
        // A square without its parent.
        const auto c = coefficients_of(kFaceResolution, random_cubemap(kFaceResolution, 1));
        const std::vector<std::uint32_t> alone{3};
        WaveletStore store(kFaceResolution);
        for (std::size_t i = 0; i < field.entry_count(); ++i) {
            store.append(SparseWavelets(SquareSet(kFaceResolution, alone), c));
        }
        field.lobes[0] = store;
    });
}

TEST(MaterialFile, IsWrittenWholeAndReadBack) {
    const test::ScratchDirectory scratch;
    const auto path = scratch.path() / "satin.material";
    write_material_file(path, random_field());
    EXPECT_EQ(bytes_from_field(read_material_file(path)), bytes_from_field(random_field()));
    MaterialField bad = random_field();
    bad.energy_fraction = 2;
    EXPECT_THROW(write_material_file(path, bad), MaterialFileError);
    EXPECT_EQ(read_material_file(path).energy_fraction, 0.75F) << "the file before is gone";
    EXPECT_THROW((void)read_material_file(scratch.path() / "none.material"), files::FileError);
    EXPECT_THROW((void)read_material_file(scratch.path()), files::FileError);
    EXPECT_TRUE(begins_as_material("RELUMEMF and more"));
    EXPECT_FALSE(begins_as_material("RELUME"));
}

}  // namespace
}  // namespace relume::tripling
