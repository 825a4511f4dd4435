// Which differences between lighting and approximation to bring into the image next.
#pragma once

#include "server/engine/lighting.h"
#include "server/engine/plan.h"
#include "server/engine/ranking.h"
#include "server/engine/scene.h"

#include <array>
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
    // Fills the plan, whose bands to reset are given, with the columns of the largest
    // importance, at equal values the lower index; the first that does not fit into the budget
    // ends it. Linear in N: the importances are sorted into buckets, and put in order only
    // within the bucket in which the budget ends.
    void choose(const Scene& scene,
                const Lighting& lighting,
                const Ranking& ranking,
                const SelectionBudget& budget,
                Plan& plan);

  private:
    // A column that differs, and its importance as bits.
    struct Candidate {
        std::uint32_t importance_bits;
        std::uint32_t column;

        [[nodiscard]] bool comes_before(const Candidate& other) const {
            return importance_bits != other.importance_bits
                       ? importance_bits > other.importance_bits
                       : column < other.column;
        }
    };
    struct Bucket {
        std::uint32_t columns = 0;
        std::uint64_t bytes = 0;
    };
    // Of non-negative floats the bits are in the order of the values: eight bits of exponent
    // and three of mantissa, so that the values of a bucket differ by an eighth at most.
    static constexpr std::uint32_t kBucketShift = 20;
    static constexpr std::size_t kBuckets = std::size_t{1} << (31 - kBucketShift);

    template <typename Visit>
    static void for_each_candidate(const Scene& scene,
                                   const Ranking& ranking,
                                   const Plan& plan,
                                   const Visit& visit);
    void fill_buckets(const Scene& scene, const Ranking& ranking, Plan& plan);
    [[nodiscard]] Candidate last_within(const Scene& scene,
                                        const Ranking& ranking,
                                        const SelectionBudget& budget,
                                        Plan& plan);

    std::array<Bucket, kBuckets> buckets_;
    std::vector<Candidate> boundary_;
};

}  // namespace relume::engine
