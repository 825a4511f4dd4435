// Random numbers and smooth noise with the same bits everywhere; std's distributions differ
// between libraries.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::scene {

// [ONeill14], PCG-XSH-RR 64/32.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1) { next(); }
    // Uniform in [low, high).
    float uniform(float low, float high);

  private:
    std::uint32_t next();
    std::uint64_t state_;
};

// Value noise in [-1, 1], continuous with its first derivative.
[[nodiscard]] float value_noise(const Imath::V3f& point, std::uint32_t seed);
// Sum of `octaves` noises, each of half the size and `gain` times the height.
[[nodiscard]] float fractal_noise(const Imath::V3f& point,
                                  std::uint32_t octaves,
                                  float gain,
                                  std::uint32_t seed);

}  // namespace relume::scene
