// Whatever happens to the files of a transport directory, opening it either gives the transport
// or names the file that is wrong.
#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"
#include "protocol/transport/shard_header.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

namespace relume::transport {
namespace {

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

class Malformed : public testing::TestWithParam<const char*> {
  protected:
    Malformed() { test::write_tiny_transport(path_, {.width = 20, .height = 20}); }

    // The error's text; empty when the directory opens.
    [[nodiscard]] std::string refusal() const {
        try {
            [[maybe_unused]] const auto transport = Transport::open(path_);
            return "";
        } catch (const TransportError& error) {
            return error.what();
        }
    }

    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "tiny.relume";
    std::filesystem::path file_ = path_ / GetParam();
};

TEST_P(Malformed, MissingFileIsNamed) {
    ASSERT_EQ(refusal(), "");
    std::filesystem::remove(file_);
    EXPECT_NE(refusal().find(file_.filename().string()), std::string::npos) << refusal();
}

TEST_P(Malformed, TruncatedFileIsNamed) {
    const std::string whole = read(file_);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100},
                                   whole.size() / 2, whole.size() - 1}) {
        write(file_, whole.substr(0, size));
        EXPECT_NE(refusal().find(file_.filename().string()), std::string::npos)
            << size << ": " << refusal();
    }
    write(file_, whole + "x");
    EXPECT_NE(refusal().find(file_.filename().string()), std::string::npos) << refusal();
}

TEST_P(Malformed, AnyFlippedBitIsRefusedByName) {
    const std::string whole = read(file_);
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> anywhere(0, whole.size() - 1);
    std::uniform_int_distribution<std::size_t> in_front(0, 300);
    for (int i = 0; i < 150; ++i) {
        const std::size_t at =
            std::min(i % 2 == 0 ? anywhere(random) : in_front(random), whole.size() - 1);
        std::string broken = whole;
        broken[at] = static_cast<char>(broken[at] ^ (1 << (i % 8)));
        write(file_, broken);
        EXPECT_NE(refusal().find(file_.filename().string()), std::string::npos)
            << "byte " << at << ": " << refusal();
    }
}

INSTANTIATE_TEST_SUITE_P(Files,
                         Malformed,
                         testing::Values("manifest.json",
                                         "columns.bin",
                                         "receivers.bin",
                                         "sketch.bin",
                                         "shards/00000.shard"));

// A pipe that nobody writes to would be waited for without end.
TEST_P(Malformed, WhatIsNoRegularFileIsRefusedAtOnce) {
    std::filesystem::remove(file_);
    ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
    EXPECT_NE(refusal().find("found a named pipe"), std::string::npos) << refusal();
    std::filesystem::remove(file_);
    std::filesystem::create_directory(file_);
    EXPECT_NE(refusal().find("found a directory"), std::string::npos) << refusal();
}

// Tables whose checksums are right are still held to what they may say.
class Values : public testing::Test {
  protected:
    Values() { test::write_tiny_transport(path_, {.width = 20, .height = 20}); }

    // Why the directory is refused after four bytes of a table became `value`, with all
    // checksums made right again; "" when it is not.
    template <typename T>
    [[nodiscard]] std::string refusal_with(const std::string& table,
                                           std::size_t offset,
                                           T value) const {
        static_assert(sizeof(T) == 4);
        const std::string before = read(path_ / table);
        const std::string manifest_before = read(path_ / "manifest.json");
        std::string bytes = before;
        std::memcpy(bytes.data() + offset, &value, sizeof(value));
        write(path_ / table, bytes);
        Manifest manifest = read_manifest(path_ / "manifest.json");
        for (FileRecord* record : {&manifest.columns, &manifest.receivers, &manifest.sketch}) {
            if (record->file == table) {
                record->checksum = checksum(std::as_bytes(std::span(bytes)));
            }
        }
        write(path_ / "manifest.json", text_from_manifest(manifest));
        std::string refusal;
        try {
            [[maybe_unused]] const auto transport = Transport::open(path_);
        } catch (const TransportError& error) {
            refusal = error.what();
        }
        write(path_ / table, before);
        write(path_ / "manifest.json", manifest_before);
        return refusal;
    }

    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "tiny.relume";
    std::size_t columns_ = 6 * 8 * 8;
    std::size_t receivers_ = 4 * 256;
};

TEST_F(Values, OnlyThoseOfTheContractAreRead) {
    const auto refuses = [&](const char* table, std::size_t offset, auto value,
                             const char* named) {
        const std::string refusal = refusal_with(table, offset, value);
        EXPECT_NE(refusal.find(named), std::string::npos) << value << ": " << refusal;
    };
    for (const float value : {-1.0F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
        refuses("columns.bin", 0, value, "step");
        refuses("columns.bin", columns_ * 4, value, "energy");
        refuses("receivers.bin", 0, value, "coverage");
        refuses("receivers.bin", receivers_ * 4, value, "tint");
        refuses("sketch.bin", 0, value, "scale");
    }
    refuses("receivers.bin", 4, 1.5F, "coverage");
    refuses("columns.bin", 4, 0.0F, "step of column 1");
    const std::size_t bytes = columns_ * (1 + 3) * 4;
    refuses("columns.bin", bytes, std::uint32_t{0xffffffff}, "bytes of column 0");
    refuses("columns.bin", bytes + 8, std::uint32_t{0}, "bytes of column 2");
    EXPECT_EQ(refusal_with("receivers.bin", 0, 1.0F), "");
}

// A header whose own checksum is right is still held to its rules.
TEST(MalformedHeader, EveryFieldIsChecked) {
    ShardHeader good;
    good.block_count = 1;
    good.columns = 96;
    good.channels = 1;
    good.index_bytes = 97 * 4;
    const auto parse = [](ShardHeader header, std::size_t file_bytes) {
        header.header_checksum = header.computed_checksum();
        std::vector<std::byte> bytes(file_bytes);
        std::memcpy(bytes.data(), &header, std::min(sizeof(header), file_bytes));
        return parse_shard_header(bytes, "x.shard");
    };
    const std::size_t size = good.file_bytes();
    EXPECT_EQ(parse(good, size).columns, 96U);
    EXPECT_THROW(parse(good, 127), TransportError);
    EXPECT_THROW(parse(good, size + 64), TransportError);
    const auto refuses = [&](auto change) {
        ShardHeader header = good;
        change(header);
        EXPECT_THROW(parse(header, size), TransportError);
    };
    refuses([](ShardHeader& header) { header.magic[0] = 'X'; });
    refuses([](ShardHeader& header) { header.version = kFormatVersion + 1; });
    refuses([](ShardHeader& header) { header.block_count = 0; });
    refuses([](ShardHeader& header) { header.block_count = 65; });
    refuses([](ShardHeader& header) { header.channels = 2; });
    refuses([](ShardHeader& header) { header.columns = 0xffffffff; });
    refuses([](ShardHeader& header) { header.index_bytes = 1; });
    refuses([](ShardHeader& header) { header.data_bytes = std::uint64_t{1} << 62; });
    refuses([](ShardHeader& header) { header.zero[3] = 1; });
}

}  // namespace
}  // namespace relume::transport
