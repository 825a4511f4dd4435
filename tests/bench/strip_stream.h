// Strips of one block, made from a seed: what the kernel of whole products is measured on.
#pragma once

#include "server/engine/kernels/strip_product.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::bench {

struct StripKind {
    std::string name;
    std::size_t per_place = 0;  // strips of a run at one place
    std::size_t targets = 0;    // products made together
};

// Places of few and of many strips, for one and for many.
[[nodiscard]] const std::vector<StripKind>& strip_kinds();

class StripStream {
  public:
    // As many runs of strips as fill `bytes`, at least one.
    StripStream(const StripKind& kind, std::size_t bytes);

    [[nodiscard]] std::size_t run_count() const { return run_count_; }
    [[nodiscard]] engine::StripRun<std::int8_t> run(std::size_t number) const;
    [[nodiscard]] std::uint64_t strips() const { return columns_.size(); }
    [[nodiscard]] std::size_t bytes() const {
        return columns_.size() * sizeof(std::uint16_t) + values_.size();
    }

  private:
    std::size_t run_count_;
    std::vector<std::uint16_t> columns_;
    std::vector<std::int8_t> values_;
    std::vector<std::uint32_t> begins_;  // [runs·32 + 1]
};

// Weights and sums of those whose products are made.
class StripTargets {
  public:
    explicit StripTargets(std::size_t count);
    [[nodiscard]] std::span<const engine::StripTarget> all() const { return targets_; }

  private:
    std::vector<float> weights_;
    std::vector<float> sums_;
    std::vector<engine::StripTarget> targets_;
};

}  // namespace relume::bench
