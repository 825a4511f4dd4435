// An estimate of the rounding error that additions have left in a set of sums.
#pragma once

#include <cstddef>

namespace relume::engine {

// The estimate is ε·√(Σ_updates ‖sums‖²). Half an ε stands for the rounding of the additions,
// and half an ε for the rounding of the amounts that are added, which errs alike in all sums.
// To measure the norm of the sums takes as long as to add a few columns. So it is measured from
// time to time, and bounded in between by the norms of what was added. A value; not
// thread-safe.
class Drift {
  public:
    // Of sums that are zero.
    Drift() = default;
    // Of sums that were made from nothing and whose norm has not been measured.
    [[nodiscard]] static Drift of_unknown_norm();

    [[nodiscard]] bool norm_is_unknown() const { return updates_since_ == kUnknown; }
    // An upper bound of ‖sums‖; means nothing while the norm is unknown.
    [[nodiscard]] double norm() const { return norm_; }
    void set_norm(double measured);

    // Records an update that adds at most `norm_of_changes` to the norm, by so many changed
    // columns. True where the norm has to be measured after it.
    [[nodiscard]] bool add(double norm_of_changes, std::size_t changes);
    // Records additions during which the norm of the sums was at most `largest_norm`.
    void record(unsigned additions, double largest_norm) {
        squared_norms_ += additions * largest_norm * largest_norm;
    }
    // The sums have been made anew; their norm is what it was.
    void forget_additions() { squared_norms_ = 0; }
    // Of the image of a band: the norm of the part that loose columns take back (LooseColumns).
    void set_cancelled_norm(double norm) { cancelled_norm_ = norm; }

    // Σ_updates ‖sums‖², in which the part that is taken back counts as one more update.
    [[nodiscard]] double squared_norms() const {
        return squared_norms_ + cancelled_norm_ * cancelled_norm_;
    }

  private:
    static constexpr unsigned kUnknown = ~0U;

    double norm_ = 0;
    double known_norm_ = 0;       // when it was last measured, or begun from nothing
    unsigned updates_since_ = 0;  // it was known
    double squared_norms_ = 0;    // Σ_updates
    double cancelled_norm_ = 0;
};

// The estimate itself, an L2 norm, from Σ_updates ‖sums‖².
[[nodiscard]] double rounding_error(double squared_norms);

}  // namespace relume::engine
