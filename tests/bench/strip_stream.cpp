#include "tests/bench/strip_stream.h"

#include <algorithm>
#include <random>

namespace relume::bench {
namespace {

using transport::kStripsPerBlock;

// As many columns as a scene takes at a time.
constexpr std::size_t kColumns = 1024;
constexpr std::size_t kStripBytes = sizeof(std::uint16_t) + transport::kStripSlots;

}  // namespace

const std::vector<StripKind>& strip_kinds() {
    static const std::vector<StripKind> kinds{
        {.name = "strip_product/4x1", .per_place = 4, .targets = 1},
        {.name = "strip_product/64x1", .per_place = 64, .targets = 1},
        {.name = "strip_product/64x4", .per_place = 64, .targets = 4},
        {.name = "strip_product/64x16", .per_place = 64, .targets = 16},
    };
    return kinds;
}

StripStream::StripStream(const StripKind& kind, std::size_t bytes)
    : run_count_(
          std::max<std::size_t>(1, bytes / (kStripBytes * kind.per_place * kStripsPerBlock))) {
    std::mt19937_64 random(1);
    begins_.push_back(0);
    for (std::size_t place = 0; place < run_count_ * kStripsPerBlock; ++place) {
        for (std::size_t i = 0; i < kind.per_place; ++i) {
            columns_.push_back(static_cast<std::uint16_t>(random() % kColumns));
        }
        std::sort(columns_.end() - static_cast<std::ptrdiff_t>(kind.per_place), columns_.end());
        begins_.push_back(static_cast<std::uint32_t>(columns_.size()));
    }
    values_.resize(columns_.size() * transport::kStripSlots);
    std::generate(values_.begin(), values_.end(),
                  [&] { return static_cast<std::int8_t>(random()); });
}

engine::StripRun<std::int8_t> StripStream::run(std::size_t number) const {
    return {
        .columns = columns_.data(),
        .values = values_.data(),
        .begins =
            std::span(begins_).subspan(number * kStripsPerBlock).first<kStripsPerBlock + 1>()};
}

StripTargets::StripTargets(std::size_t count)
    : weights_(count * kColumns * engine::kWeightsPerColumn, 0.5F),
      sums_(count * transport::kColours * transport::kBlockSize) {
    for (std::size_t t = 0; t < count; ++t) {
        targets_.push_back({.weights = &weights_[t * kColumns * engine::kWeightsPerColumn],
                            .sums = &sums_[t * transport::kColours * transport::kBlockSize]});
    }
}

}  // namespace relume::bench
