// Whatever happens to the files of a transport directory, opening it either gives the transport
// or names the file that is wrong.
#include "protocol/transport/error.h"
#include "protocol/transport/shard_header.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
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
