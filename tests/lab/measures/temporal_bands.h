// How fast a light changes at every scale, whatever method follows it [Overbeck06T §5.2].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

// Energy of a light over images: each coefficient's values, image by image, are brought into
// the orthonormal Haar basis of time. Temporal band 0 is the mean over all images, band t > 0
// the differences between neighbouring runs of images/2^t images each.
struct TemporalSpectrum {
    std::uint32_t images = 0;                 // a power of two, or 0: there is none
    std::vector<std::vector<double>> energy;  // [spatial band][temporal band]
};

// Of the first 2^k images, all colours together. Not thread-safe.
class TemporalBands {
  public:
    // `bands` of every coefficient, [N]; kept by reference.
    explicit TemporalBands(std::span<const std::uint8_t> bands) : bands_(bands) {}

    // The next image's coefficients, planar [3][N].
    void add(std::span<const float> lighting);
    // k as large as the images added allow.
    [[nodiscard]] TemporalSpectrum spectrum() const;

  private:
    std::span<const std::uint8_t> bands_;
    std::vector<std::vector<float>> lightings_;
};

}  // namespace relume::lab
