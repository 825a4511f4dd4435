// One stream of random numbers per pixel, reproducible whatever the threads.
#pragma once

#include <cstdint>

namespace relume::reference {

// splitmix64 [Steele14].
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    // Uniform in [0, 1).
    double uniform() {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        z ^= z >> 31U;
        return static_cast<double>(z >> 11U) * 0x1.0p-53;
    }

  private:
    std::uint64_t state_;
};

}  // namespace relume::reference
