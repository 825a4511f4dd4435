#include "server/engine/swept_segments.h"

#include <algorithm>

namespace relume::engine {
namespace {

using transport::kColours;

// Members that want a segment, on average, from which on the batch kernel is the faster one.
// The result is the same.
constexpr double kWorthABatch = 3.5;

// Of long lists some, by the address, so that all members' samples are of the same
// segments.
bool is_sampled(const std::uint8_t* segment, std::size_t list_size) {
    constexpr std::size_t kShort = 256;
    constexpr std::uintptr_t kOneIn = 61;
    return list_size <= kShort || reinterpret_cast<std::uintptr_t>(segment) % kOneIn == 0;
}

WeightedSegment weighted(const transport::Transport& transport,
                         const transport::SegmentView& segment,
                         const ColumnChange& change,
                         std::uint32_t channel) {
    const transport::ColourModel& colour = transport.manifest().colour;
    const float step = transport.step(change.column, channel);
    WeightedSegment weighted{.segment = segment, .weights = {}};
    for (std::size_t c = 0; c < kColours; ++c) {
        weighted.weights[c] = step * colour.matrix[c][channel] * change.amount[c];
    }
    return weighted;
}

// Where groups would end if all columns of a band were summed.
class Stretches {
  public:
    // The stretch of the next segment.
    std::uint32_t next(std::uint32_t bytes) {
        if (segments_ == kMaxGroupSegments || bytes_ >= kMaxGroupBytes) {
            ++stretch_;
            segments_ = 0;
            bytes_ = 0;
        }
        ++segments_;
        bytes_ += bytes;
        return stretch_;
    }

  private:
    std::uint32_t stretch_ = 0;
    std::size_t segments_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace

SweptSegments& SweptSegments::of_this_thread() {
    thread_local SweptSegments segments;
    return segments;
}

std::vector<WeightedSegment>& SweptSegments::add(const SumTargets& targets) {
    targets_[count_] = targets;
    lists_[count_].clear();
    return lists_[count_++];
}

void SweptSegments::accumulate(std::uint32_t block_count) const {
    std::array<BatchMember, kMaxBatchMembers> members;
    for (std::size_t m = 0; m < count_; ++m) {
        members[m] = {.segments = lists_[m], .targets = targets_[m]};
    }
    if (shared() >= kWorthABatch) {
        accumulate_batch(std::span(members).first(count_), block_count);
        return;
    }
    for (const BatchMember& member : std::span(members).first(count_)) {
        accumulate_segments(member.segments, block_count, member.targets);
    }
}

double SweptSegments::shared() const {
    thread_local std::vector<const std::uint8_t*> wanted;
    wanted.clear();
    for (const auto& list : std::span(lists_).first(count_)) {
        for (const WeightedSegment& segment : list) {
            if (is_sampled(segment.segment.tags, list.size())) {
                wanted.push_back(segment.segment.tags);
            }
        }
    }
    const auto all = static_cast<double>(wanted.size());
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    return wanted.empty() ? 0 : all / static_cast<double>(wanted.size());
}

std::uint64_t gather_changes(const transport::Transport& transport,
                             std::size_t shard,
                             std::span<const ColumnChange> changes,
                             std::vector<WeightedSegment>& segments) {
    const transport::ShardReader& reader = transport.shards()[shard];
    std::uint64_t occupied = 0;
    for (const ColumnChange& change : changes) {
        for (std::uint32_t k = 0; k < transport.channel_count(); ++k) {
            const transport::SegmentView segment = reader.segment(change.column, k);
            if (!segment.empty()) {
                segments.push_back(weighted(transport, segment, change, k));
                occupied |= segment.occupied_blocks(reader.block_count());
            }
        }
    }
    return occupied;
}

void gather_lighting(const Scene& scene,
                     std::size_t shard,
                     std::uint32_t band,
                     std::span<const float> lighting,
                     std::vector<WeightedSegment>& segments) {
    const transport::Transport& transport = scene.transport();
    const transport::ShardReader& reader = transport.shards()[shard];
    Stretches stretches;
    for (const std::uint32_t column : scene.columns_of_band(band)) {
        const ColumnChange change = column_of(scene, lighting, column);
        for (std::uint32_t k = 0; k < transport.channel_count(); ++k) {
            const std::uint32_t bytes = reader.segment_bytes(column, k);
            if (bytes == 0) {
                continue;
            }
            const std::uint32_t stretch = stretches.next(bytes);
            if (!change.is_nothing()) {
                segments.push_back(weighted(transport, reader.segment(column, k), change, k));
                segments.back().stretch = stretch;
            }
        }
    }
}

}  // namespace relume::engine
