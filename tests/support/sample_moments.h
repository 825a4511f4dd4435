// The mean of samples and how far it may be off, one sample after another (Welford).
#pragma once

#include <cstdint>

namespace relume::test {

// Of numbers or vectors, whose products are by component.
template <typename Value>
class SampleMoments {
  public:
    explicit SampleMoments(const Value& zero) : mean_(zero), scatter_(zero) {}

    void add(const Value& value) {
        const Value step = value - mean_;
        mean_ += step / static_cast<double>(++count_);
        scatter_ += step * (value - mean_);
    }

    [[nodiscard]] const Value& mean() const { return mean_; }
    // Of at least two samples, unbiased: of one of them, and of their mean.
    [[nodiscard]] Value variance() const {
        return scatter_ / (static_cast<double>(count_) - 1.0);
    }
    [[nodiscard]] Value variance_of_mean() const {
        const auto n = static_cast<double>(count_);
        return scatter_ / (n * (n - 1.0));
    }

  private:
    std::uint64_t count_ = 0;
    Value mean_;
    Value scatter_;  // sum of squared deviations from the mean
};

}  // namespace relume::test
