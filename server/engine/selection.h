// Which differences between lighting and approximation to bring into the image next.
#pragma once

#include "server/engine/lighting.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// What one image may cost; whichever is reached first ends the selection, which holds at least
// one column if any differs.
struct SelectionBudget {
    std::uint32_t columns = 0;
    std::uint64_t bytes = 0;
};

// Reused from image to image so that the steady state allocates nothing. Not thread-safe.
class Selection {
  public:
    // Takes the columns of the largest Σ_c (weight(c,j)·(L − L̃)(c,j))², at equal values the
    // lower index, and orders them by band and index.
    void choose(const Scene& scene,
                const Lighting& lighting,
                std::span<const float> weights,
                const SelectionBudget& budget);

    [[nodiscard]] std::span<const ColumnChange> changes() const { return changes_; }
    // Of all columns that differ, chosen or not.
    [[nodiscard]] std::uint32_t differing_columns() const {
        return static_cast<std::uint32_t>(candidates_.size());
    }
    [[nodiscard]] std::uint64_t differing_bytes() const { return differing_bytes_; }
    [[nodiscard]] std::uint64_t chosen_bytes() const { return chosen_bytes_; }

  private:
    struct Candidate {
        float importance;
        std::uint32_t column;
    };

    void gather(const Scene& scene, const Lighting& lighting, std::span<const float> weights);
    [[nodiscard]] std::size_t take_most_important(const Scene& scene,
                                                  const SelectionBudget& budget);

    std::vector<Candidate> candidates_;
    std::vector<ColumnChange> changes_;
    std::uint64_t differing_bytes_ = 0;
    std::uint64_t chosen_bytes_ = 0;
};

}  // namespace relume::engine
