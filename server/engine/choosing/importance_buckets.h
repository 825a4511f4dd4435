// A histogram of importances. It tells at which importance a budget ends, without sorting.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace relume::engine {

// What one image may cost. The limit that is reached first ends the selection. A selection
// holds at least one column if any differs.
struct SelectionBudget {
    std::uint32_t columns = 0;
    std::uint64_t bytes = 0;
};

// The bits of non-negative floats are in the order of their values. A bucket is given by the
// eight bits of the exponent and the upper three of the mantissa, so that the values in a
// bucket differ by an eighth at most. Not thread-safe.
class ImportanceBuckets {
  public:
    [[nodiscard]] static std::size_t bucket_of(float importance) {
        return std::bit_cast<std::uint32_t>(importance) >> kShift;
    }

    // The least importance of a bucket.
    [[nodiscard]] static float lower_end(std::size_t bucket) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(bucket) << kShift);
    }

    void clear() { buckets_.fill({}); }
    // `importance` is finite and not negative.
    void add(float importance, std::uint64_t bytes) {
        Bucket& bucket = buckets_[bucket_of(importance)];
        bucket.columns += 1;
        bucket.bytes += bytes;
    }

    // The bucket in which the budget ends: all buckets above it fit into the budget as a whole,
    // and hold so many columns and bytes. kNone where everything fits.
    struct End {
        std::size_t bucket = 0;
        std::uint32_t columns_above = 0;
        std::uint64_t bytes_above = 0;
    };
    static constexpr std::size_t kNone = ~std::size_t{0};
    [[nodiscard]] End end_of(const SelectionBudget& budget) const {
        End end;
        for (std::size_t bucket = buckets_.size(); bucket-- > 0;) {
            const Bucket& next = buckets_[bucket];
            if (end.columns_above + next.columns > budget.columns ||
                end.bytes_above + next.bytes > budget.bytes) {
                end.bucket = bucket;
                return end;
            }
            end.columns_above += next.columns;
            end.bytes_above += next.bytes;
        }
        end.bucket = kNone;
        return end;
    }
    // The lower end of the bucket in which the budget ends; what is less important does not
    // fit.
    [[nodiscard]] float least_within(const SelectionBudget& budget) const {
        const std::size_t bucket = end_of(budget).bucket;
        return bucket == kNone ? 0 : lower_end(bucket);
    }

  private:
    struct Bucket {
        std::uint32_t columns = 0;
        std::uint64_t bytes = 0;
    };
    static constexpr std::uint32_t kShift = 20;

    std::array<Bucket, std::size_t{1} << (31 - kShift)> buckets_{};
};

}  // namespace relume::engine
