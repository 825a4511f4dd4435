#include "server/engine/selection.h"

#include <algorithm>

namespace relume::engine {

using transport::kColours;

void Selection::choose(const Scene& scene,
                       const Lighting& lighting,
                       std::span<const float> weights,
                       const SelectionBudget& budget) {
    gather(scene, lighting, weights);
    const std::size_t taken = take_most_important(scene, budget);
    std::sort(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(taken),
              [bands = scene.bands()](const Candidate& a, const Candidate& b) {
                  return bands[a.column] != bands[b.column] ? bands[a.column] < bands[b.column]
                                                            : a.column < b.column;
              });
    changes_.clear();
    for (std::size_t i = 0; i < taken; ++i) {
        changes_.push_back(lighting.difference(candidates_[i].column));
    }
}

void Selection::gather(const Scene& scene,
                       const Lighting& lighting,
                       std::span<const float> weights) {
    const std::size_t count = scene.coefficient_count();
    candidates_.reserve(count);
    changes_.reserve(count);
    candidates_.clear();
    differing_bytes_ = 0;
    for (std::size_t j = 0; j < count; ++j) {
        if (!lighting.differs(j)) {
            continue;
        }
        const ColumnChange change = lighting.difference(j);
        float importance = 0;
        for (std::size_t c = 0; c < kColours; ++c) {
            const float weighted = weights[c * count + j] * change.amount[c];
            importance += weighted * weighted;
        }
        candidates_.push_back({importance, static_cast<std::uint32_t>(j)});
        differing_bytes_ += scene.transport().column_bytes(j);
    }
}

std::size_t Selection::take_most_important(const Scene& scene, const SelectionBudget& budget) {
    const auto more_important = [](const Candidate& a, const Candidate& b) {
        return a.importance != b.importance ? a.importance > b.importance : a.column < b.column;
    };
    const std::size_t limit = std::min<std::size_t>(candidates_.size(), budget.columns);
    chosen_bytes_ = 0;
    std::size_t taken = 0;
    // Ever larger heads of the list are put in order, so that a small budget out of many
    // candidates costs one linear pass.
    constexpr std::size_t kFirstHead = 64;
    for (std::size_t head = kFirstHead; taken < limit; head *= 4) {
        const std::size_t end = std::min(head, limit);
        const auto first = candidates_.begin() + static_cast<std::ptrdiff_t>(taken);
        const auto last = candidates_.begin() + static_cast<std::ptrdiff_t>(end);
        std::nth_element(first, last, candidates_.end(), more_important);
        std::sort(first, last, more_important);
        for (; taken < end; ++taken) {
            const std::uint32_t bytes =
                scene.transport().column_bytes(candidates_[taken].column);
            if (taken > 0 && chosen_bytes_ + bytes > budget.bytes) {
                return taken;
            }
            chosen_bytes_ += bytes;
        }
    }
    return taken;
}

}  // namespace relume::engine
