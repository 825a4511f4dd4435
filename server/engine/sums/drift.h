// How much rounding additions have left in a set of sums.
#pragma once

#include <cstddef>

namespace relume::engine {

// An estimate, ε·√(Σ_updates ‖sums‖²): half an ε for the additions and half a one for the
// amounts, which err alike everywhere. It needs the sums' norm, which is measured now and then,
// for that takes as long as adding a few columns; in between it is bounded by what was added.
// A value; not thread-safe.
class Drift {
  public:
    // Of sums that are zero.
    Drift() = default;
    // Of sums made from nothing, nobody knows how large.
    [[nodiscard]] static Drift of_unknown_norm();

    [[nodiscard]] bool norm_is_unknown() const { return updates_since_ == kUnknown; }
    // Not less than ‖sums‖, while it is known.
    [[nodiscard]] double norm() const { return norm_; }
    void set_norm(double measured);

    // An update of so many columns adds so much at most; whether the norm must be measured
    // after it.
    [[nodiscard]] bool add(double norm_of_changes, std::size_t changes);
    // So many additions passed through sums of at most that norm.
    void record(unsigned additions, double largest_norm) {
        squared_norms_ += additions * largest_norm * largest_norm;
    }
    // The sums have been made anew; their norm is what it was.
    void forget_additions() { squared_norms_ = 0; }
    // Of a band: loose columns may have taken back so much of it (LooseColumns).
    void set_cancelled_norm(double norm) { cancelled_norm_ = norm; }

    // Σ_updates ‖sums‖², what is cancelled counted as one more.
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

// L2 norm of the rounding error that additions to sums of such squared norms have left.
[[nodiscard]] double rounding_error(double squared_norms);

}  // namespace relume::engine
