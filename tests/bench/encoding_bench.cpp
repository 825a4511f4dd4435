// Bytes against time: the cells of a baked scene encoded anew at several rates of exchange, and
// added by the kernel.
#include "protocol/basis/haar.h"
#include "protocol/transport/cell_cost.h"
#include "protocol/transport/transport.h"
#include "server/engine/kernels/accumulate.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <limits>
#include <vector>

namespace relume::bench {
namespace {

using transport::CellShape;
using transport::CellTag;

// Nanoseconds a byte; the last is as good as bytes alone.
constexpr std::array kRates{0.0, 0.16, 0.32, 0.64, 1.28, 1e6};
constexpr std::size_t kRounds = 7;
// Segments that are timed at once: short, so that the least of all rounds met no neighbour.
constexpr std::size_t kSegmentsAtOnce = 512;

CellTag cheapest_at(double nanoseconds_per_byte, const CellShape& shape) {
    CellTag best = CellTag::dense32f;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < transport::kCellTagCount; ++i) {
        const auto tag = static_cast<CellTag>(i);
        if (shape.fits(tag)) {
            const double cost = shape.nanoseconds(tag) +
                                nanoseconds_per_byte * static_cast<double>(shape.bytes(tag));
            if (cost < least) {
                least = cost;
                best = tag;
            }
        }
    }
    return best;
}

// The segments of one shard, encoded at one rate.
class EncodedShard {
  public:
    explicit EncodedShard(double rate) : rate_(rate) {}

    void append(const transport::SegmentView& segment, std::uint32_t block_count) {
        begins_.push_back(bytes_.size());
        bytes_.resize(bytes_.size() + transport::tag_bytes(block_count), 0);
        const std::uint8_t* cell = segment.cells;
        for (std::uint32_t block = 0; block < block_count; ++block) {
            transport::DecodedCell values;
            cell = transport::decode_cell(segment.tag(block), cell, values);
            transport::QuantisedCell quantised;
            std::transform(values.begin(), values.end(), quantised.begin(),
                           [](float value) { return static_cast<std::int32_t>(value); });
            const CellTag tag = cheapest_at(rate_, CellShape::of(quantised));
            const unsigned shifted = static_cast<unsigned>(tag) << (block % 2 * 4);
            std::uint8_t& tags = bytes_[begins_.back() + block / 2];
            tags = static_cast<std::uint8_t>(tags | shifted);
            transport::append_cell_as(tag, quantised, bytes_);
        }
    }

    // To be called once, when all are there.
    [[nodiscard]] std::vector<engine::WeightedSegment> finish(std::uint32_t block_count) {
        size_ = bytes_.size();
        bytes_.resize(size_ + transport::kShardTailBytes);
        std::vector<engine::WeightedSegment> segments;
        for (std::size_t i = 0; i < begins_.size(); ++i) {
            const std::uint8_t* tags = &bytes_[begins_[i]];
            const std::size_t end = i + 1 < begins_.size() ? begins_[i + 1] : size_;
            segments.push_back({.segment = {.tags = tags,
                                            .cells = tags + transport::tag_bytes(block_count),
                                            .end = bytes_.data() + end},
                                .weights = {0.5F, -0.25F, 0.125F}});
        }
        return segments;
    }
    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    double rate_;
    std::vector<std::uint8_t> bytes_;
    std::vector<std::size_t> begins_;
    std::size_t size_ = 0;
};

struct Outcome {
    std::size_t bytes = 0;
    double seconds = 0;  // one thread; the least of the rounds
};

// Columns in the order of bands, as images are summed.
void measure(const transport::ShardReader& shard,
             std::uint32_t face_resolution,
             std::array<Outcome, kRates.size()>& outcomes) {
    std::vector<EncodedShard> encoded(kRates.begin(), kRates.end());
    const std::uint32_t blocks = shard.block_count();
    for (std::uint32_t band = 0; band < basis::band_count(face_resolution); ++band) {
        for (std::size_t j = 0; j < shard.header().columns; ++j) {
            for (std::uint32_t k = 0; k < shard.header().channels; ++k) {
                const auto segment = shard.segment(j, k);
                if (!segment.empty() &&
                    basis::band_from_coefficient(face_resolution, j) == band) {
                    for (EncodedShard& each : encoded) {
                        each.append(segment, blocks);
                    }
                }
            }
        }
    }
    std::vector<std::vector<engine::WeightedSegment>> segments;
    for (std::size_t i = 0; i < kRates.size(); ++i) {
        segments.push_back(encoded[i].finish(blocks));
        outcomes[i].bytes += encoded[i].size();
    }
    std::vector<float> sums(std::size_t{blocks} * transport::kColours * transport::kBlockSize);
    for (std::size_t first = 0; first < segments[0].size(); first += kSegmentsAtOnce) {
        const std::size_t count = std::min(kSegmentsAtOnce, segments[0].size() - first);
        std::vector<test::TimedVariant> variants;
        for (const auto& of_rate : segments) {
            variants.emplace_back([&](std::size_t /*round*/) {
                engine::accumulate_segments(std::span(of_rate).subspan(first, count), blocks,
                                            {.sums = sums.data(), .total = nullptr});
            });
        }
        const auto seconds = test::seconds_in_turn(variants, kRounds);
        for (std::size_t i = 0; i < kRates.size(); ++i) {
            outcomes[i].seconds += *std::min_element(seconds[i].begin(), seconds[i].end());
        }
    }
}

void run(const char* directory) {
    const auto transport = transport::Transport::open(directory);
    const auto& shards = transport->shards();
    std::array<Outcome, kRates.size()> outcomes{};
    // The middle of the image stands for all of it.
    measure(shards[shards.size() / 2], transport->manifest().signal_basis.cubemap().face_resolution(),
            outcomes);
    const Outcome& by_bytes = outcomes.back();
    fmt::print("{:>10} {:>12} {:>8} {:>8}\n", "ns/byte", "bytes", "bytes ÷", "time ÷");
    for (std::size_t i = 0; i < kRates.size(); ++i) {
        fmt::print("{:>10} {:>12} {:>8.2f} {:>8.2f}\n", kRates[i], outcomes[i].bytes,
                   static_cast<double>(outcomes[i].bytes) / static_cast<double>(by_bytes.bytes),
                   outcomes[i].seconds / by_bytes.seconds);
    }
}

}  // namespace
}  // namespace relume::bench

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: relume-encoding-bench NAME.relume\n");
        return 2;
    }
    try {
        relume::bench::run(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "relume-encoding-bench: {}\n", error.what());
        return 1;
    }
}
