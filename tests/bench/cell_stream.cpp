#include "tests/bench/cell_stream.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace relume::bench {
namespace {

using transport::kBlockSize;

// "strips8/64" is a cell of encoding strips8.
transport::CellTag encoding_of(const CellKind& kind) {
    const auto& names = transport::kCellTagNames;
    const auto* name =
        std::find(names.begin(), names.end(), kind.name.substr(0, kind.name.find('/')));
    return static_cast<transport::CellTag>(name - names.begin());
}

transport::QuantisedCell random_cell(const CellKind& kind, std::mt19937_64& random) {
    std::array<std::uint8_t, kBlockSize> slots{};
    std::iota(slots.begin(), slots.end(), std::uint8_t{0});
    std::shuffle(slots.begin(), slots.end(), random);
    std::uniform_int_distribution<std::int32_t> magnitude(1, kind.range);
    transport::QuantisedCell cell{};
    for (std::size_t i = 0; i < kind.nonzeros; ++i) {
        const std::int32_t value = magnitude(random);
        cell[slots[i]] = (random() & 1U) != 0 ? value : -value;
    }
    return cell;
}

}  // namespace

const std::vector<CellKind>& cell_kinds() {
    constexpr std::int32_t kRange16 = 2000;
    constexpr std::int32_t kRange32 = 100000;
    static const std::vector<CellKind> kinds{
        {.name = "empty"},
        {.name = "strips8/1", .nonzeros = 1},
        {.name = "strips8/4", .nonzeros = 4},
        {.name = "strips8/16", .nonzeros = 16},
        {.name = "strips8/64", .nonzeros = 64},
        {.name = "strips8/128", .nonzeros = 128},
        {.name = "dense8/256", .nonzeros = 256},
        {.name = "dense16/256", .nonzeros = 256, .range = kRange16},
        {.name = "dense32f/256", .nonzeros = 256, .range = kRange32},
    };
    return kinds;
}

CellStream::CellStream(const CellKind& kind, std::uint32_t block_count, std::size_t bytes)
    : block_count_(block_count), nonzeros_per_cell_(kind.nonzeros) {
    // A few different columns are enough: what they are filled with is drawn only once, their
    // copies lie in memory of their own.
    constexpr std::size_t kDifferent = 16;
    std::mt19937_64 random(1);
    const transport::CellTag tag = encoding_of(kind);
    std::vector<std::vector<std::uint8_t>> columns(kDifferent);
    for (std::vector<std::uint8_t>& column : columns) {
        column.resize(transport::tag_bytes(block_count), 0);
        for (std::uint32_t block = 0; block < block_count; ++block) {
            transport::append_cell_as(tag, random_cell(kind, random), column);
            const unsigned shift = (block & 1U) * 4U;
            column[block / 2] = static_cast<std::uint8_t>(
                column[block / 2] | (static_cast<unsigned>(tag) << shift));
        }
    }
    const std::size_t count =
        std::max<std::size_t>(kFewestColumns, bytes / columns.front().size());
    std::vector<std::size_t> begins;
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<std::uint8_t>& column = columns[i % kDifferent];
        begins.push_back(data_.size());
        data_.insert(data_.end(), column.begin(), column.end());
        ends.push_back(data_.size());
    }
    bytes_ = data_.size();
    // As behind a shard's data: vector loads may run past the last cell.
    data_.resize(bytes_ + transport::kShardTailBytes, 0);
    std::uniform_real_distribution<float> weight(-1, 1);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* tags = data_.data() + begins[i];
        segments_.push_back({.segment = {.tags = tags,
                                         .cells = tags + transport::tag_bytes(block_count),
                                         .end = data_.data() + ends[i]},
                             .weights = {weight(random), weight(random), weight(random)}});
    }
}

}  // namespace relume::bench
