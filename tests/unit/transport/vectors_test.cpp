// The transport directories of protocol/transport/vectors: what they hold by the page alone,
// and that the writer gives their very bytes. `RELUME_WRITE_VECTORS=1` writes them anew.
#include "protocol/transport/cell_cost.h"
#include "protocol/transport/transport.h"
#include "protocol/transport/transport_writer.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>

namespace relume::transport {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr TileGrid kImage{.width = 24, .height = 10};

struct Vector {
    const char* name;
    basis::CubemapBasis basis;
    std::uint32_t channels;
};
std::vector<Vector> vectors() {
    return {
        {.name = "haar", .basis = basis::CubemapBasis::haar(4), .channels = 3},
        {.name = "sh", .basis = basis::CubemapBasis::spherical_harmonics(3, 4), .channels = 1}};
}

// Some values that the encoding can hold; few of them where it stores strips.
QuantisedCell cell_for(CellTag tag, std::mt19937& random) {
    const std::size_t parts = upper_parts(tag);
    const std::int32_t range = tag == CellTag::dense16    ? 32767
                               : tag == CellTag::dense32f ? 1 << 23
                               : parts == 0               ? 127
                               : parts == 1               ? 20000
                                                          : 5'000'000;
    const bool is_dense = low_tag(tag) != CellTag::strips8;
    QuantisedCell cell{};
    for (std::int32_t& value : cell) {
        const auto draw =
            static_cast<std::int32_t>(random() % (2U * static_cast<unsigned>(range) + 1U));
        const bool is_kept = is_dense || random() % 16 == 0;
        value = is_kept ? draw - range : 0;
    }
    // Few upper parts beside many low ones, and never none.
    for (std::size_t slot = 0; parts > 0 && slot < cell.size(); ++slot) {
        const auto draw =
            static_cast<std::int32_t>(random() % static_cast<unsigned>(range / 2));
        cell[slot] =
            slot % 29 == 3 ? (slot % 2 == 0 ? 1 : -1) * (range / 2 + draw) : cell[slot] % 127;
    }
    return cell;
}

// A whole directory in memory; `cells[block][segment]`.
struct Content {
    Manifest manifest;
    BakedTables tables;
    std::vector<std::vector<std::pair<CellTag, QuantisedCell>>> cells;
};

Content content_of(const Vector& vector) {
    Content content;
    Manifest& manifest = content.manifest;
    manifest.generator = "relume test vectors";
    manifest.fingerprint = 0x0123'4567'89AB'CDEF;
    manifest.layout = transport::ReceiverLayout::pixel_tiles(kImage);
    manifest.signal_basis = vector.basis;
    manifest.stating_rows = 16;
    manifest.choosing_rows = 16;
    manifest.colour.channels = vector.channels;
    manifest.colour.matrix = {{{1, 0.5F, 0}, {1, -0.25F, 0.25F}, {1, 0, -0.5F}}};
    if (vector.channels == 1) {
        manifest.colour.matrix = {{{1}, {0.75F}, {0.5F}}};
    }
    const std::size_t segments = std::size_t{manifest.column_count()} * vector.channels;
    for (std::size_t segment = 0; segment < segments; ++segment) {
        content.tables.steps.push_back(static_cast<float>(1 + segment % 5) / 1024);
    }
    // mt19937's numbers are the standard's; distributions are not.
    std::mt19937 random(7);
    for (std::uint32_t block = 0; block < manifest.block_count(); ++block) {
        auto& cells = content.cells.emplace_back();
        for (std::size_t segment = 0; segment < segments; ++segment) {
            // Every encoding in every block, each beside every other, then columns of nothing.
            const std::size_t last = std::min<std::size_t>(segments, 27);
            const auto tag = segment < last
                                 ? static_cast<CellTag>((segment + 2 * block) % kCellTagCount)
                                 : CellTag::empty;
            cells.emplace_back(tag,
                               tag == CellTag::empty ? QuantisedCell{} : cell_for(tag, random));
        }
    }
    const std::size_t receivers = std::size_t{manifest.block_count()} * kBlockSize;
    content.tables.coverage.assign(receivers, 0);
    content.tables.tint.assign(receivers * kColours, 0);
    for (std::uint32_t y = 0; y < kImage.height; ++y) {
        for (std::uint32_t x = 0; x < kImage.width; ++x) {
            const auto [block, slot] = kImage.place_from_pixel(x, y);
            content.tables.coverage[block * kBlockSize + slot] = static_cast<float>(x % 5) / 4;
            for (std::size_t c = 0; c < kColours; ++c) {
                content.tables.tint[(block * kColours + c) * kBlockSize + slot] =
                    static_cast<float>(1 + (x + 2 * y + 3 * c) % 8) / 8;
            }
        }
    }
    return content;
}

void write(const Content& content, const fs::path& directory) {
    const ShardPlan plan = ShardPlan::equal(content.manifest.block_count(), 2);
    TransportWriter writer(directory, content.manifest, plan);
    for (std::uint32_t shard = 0; shard < plan.shard_count(); ++shard) {
        std::vector<EncodedBlock> blocks;
        for (std::uint32_t i = 0; i < plan.blocks_in(shard); ++i) {
            const auto& cells = content.cells[plan.first_block(shard) + i];
            blocks.emplace_back(cells.size());
            for (const auto& [tag, values] : cells) {
                blocks.back().append_as(tag, values);
            }
        }
        writer.write_shard(shard, blocks);
    }
    writer.finish(content.tables, json::object());
}

// T(p,c,j) by its definition: wavelet by wavelet, from the values before they are encoded.
double transport_at(
    const Content& content, std::uint32_t x, std::uint32_t y, std::size_t c, std::size_t j) {
    const auto [block, slot] = kImage.place_from_pixel(x, y);
    const std::uint32_t row = y % kTileSide;
    const std::uint32_t column = x % kTileSide;
    double sum = 0;
    for (std::uint32_t k = 0; k < content.manifest.colour.channels; ++k) {
        const std::size_t segment = j * content.manifest.colour.channels + k;
        const QuantisedCell& q = content.cells[block][segment].second;
        double value = q[0] / 16.0;
        for (std::uint32_t level = 0; level < 4; ++level) {
            const std::uint32_t support = kTileSide >> level;
            std::uint32_t z = 0;
            for (std::uint32_t bit = 0; bit < level; ++bit) {
                z |= (column / support >> bit & 1U) << (2 * bit);
                z |= (row / support >> bit & 1U) << (2 * bit + 1);
            }
            const std::size_t first = (std::size_t{1} << (2 * level)) + 3 * z;
            const double along = column % support < support / 2 ? 1 : -1;
            const double down = row % support < support / 2 ? 1 : -1;
            value += (along * q[first] + down * q[first + 1] + along * down * q[first + 2]) /
                     support;
        }
        sum += double{content.manifest.colour.matrix[c][k]} *
               double{content.tables.steps[segment]} * value;
    }
    return sum * double{content.tables.tint[(block * kColours + c) * kBlockSize + slot]};
}

json values_of(const Content& content) {
    json values = json::array();
    const std::size_t columns = std::min<std::size_t>(content.manifest.column_count(), 12);
    for (std::size_t j = 0; j < columns; ++j) {
        for (const auto& [x, y] :
             {std::pair{0U, 0U}, {15U, 9U}, {16U, 3U}, {23U, 8U}, {7U, 5U}}) {
            for (std::size_t c = 0; c < kColours; ++c) {
                values.push_back({{"x", x},
                                  {"y", y},
                                  {"colour", c},
                                  {"column", j},
                                  {"value", transport_at(content, x, y, c, j)}});
            }
        }
    }
    return values;
}

std::map<std::string, std::string> files_of(const fs::path& directory) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
        if (entry.is_regular_file()) {
            std::ifstream file(entry.path(), std::ios::binary);
            files[entry.path().lexically_relative(directory)] = {
                std::istreambuf_iterator<char>(file), {}};
        }
    }
    return files;
}

TEST(TransportVectors, TheWriterGivesTheirBytes) {
    const fs::path folder = RELUME_TRANSPORT_VECTORS;
    for (const Vector& vector : vectors()) {
        const Content content = content_of(vector);
        const std::string directory = std::string(vector.name) + ".relume";
        const std::string values = std::string(vector.name) + ".json";
        const std::string text = values_of(content).dump(1) + "\n";
        if (std::getenv("RELUME_WRITE_VECTORS") != nullptr) {
            fs::remove_all(folder / directory);
            write(content, folder / directory);
            std::ofstream(folder / values) << text;
        }
        const test::ScratchDirectory scratch;
        write(content, scratch.path() / directory);
        const auto written = files_of(scratch.path() / directory);
        const auto expected = files_of(folder / directory);
        ASSERT_EQ(written.size(), expected.size());
        for (const auto& [name, bytes] : expected) {
            EXPECT_TRUE(written.at(name) == bytes) << directory << "/" << name;
        }
        std::ifstream file(folder / values);
        EXPECT_EQ(json::parse(file), json::parse(text));
    }
}

TEST(TransportVectors, HoldEveryEncodingAndTheStatedValues) {
    for (const Vector& vector : vectors()) {
        const fs::path folder = RELUME_TRANSPORT_VECTORS;
        const auto opened = Transport::open(folder / (std::string(vector.name) + ".relume"));
        const Transport& transport = *opened;
        std::set<CellTag> tags;
        const ShardReader& shard = transport.shards().front();
        const std::uint32_t channels = transport.manifest().colour.channels;
        const Content content = content_of(vector);
        for (std::size_t j = 0; j < transport.column_count(); ++j) {
            for (std::uint32_t k = 0; k < channels; ++k) {
                const SegmentView segment = shard.segment(j, k);
                const std::uint8_t* cell = segment.cells;
                for (std::uint32_t block = 0; !segment.empty() && block < 2; ++block) {
                    tags.insert(segment.tag(block));
                    DecodedCell values{};
                    cell = decode_cell(segment.tag(block), cell, values);
                    const auto& expected = content.cells[block][j * channels + k].second;
                    EXPECT_TRUE(std::equal(
                        values.begin(), values.end(), expected.begin(),
                        [](float a, std::int32_t b) { return a == static_cast<float>(b); }));
                }
            }
        }
        EXPECT_EQ(tags.size(), kCellTagCount);
    }
}

}  // namespace
}  // namespace relume::transport
