// What something has been taking lately.
#pragma once

namespace relume::timing {

// An exponential average, of which the newest value is a fifth. Not thread-safe.
class RunningMean {
  public:
    // `guess`: the mean before there is any value.
    explicit RunningMean(double guess = 0) : mean_(guess) {}

    void add(double newest) {
        constexpr double kNewest = 0.2;
        mean_ += kNewest * (newest - mean_);
    }
    [[nodiscard]] double mean() const { return mean_; }

  private:
    double mean_;
};

}  // namespace relume::timing
