// Many sparse functions on cubemaps of one resolution, one behind the other, as kernels read
// them.
#pragma once

#include "protocol/tripling/sparse_wavelets.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::tripling {

// The three coefficients of a square in lanes 1 to 3, in the order of kWaveletTypes: lane 0 is
// that of the part that is constant over the square, and zero here.
using SquareLanes = std::array<float, 4>;

// One function of a store, which it refers to.
struct WaveletView {
    std::array<float, basis::kFaceCount> scaling{};
    // Of each face the first of its squares, and the number of all squares.
    std::array<std::uint32_t, basis::kFaceCount + 1> first{};
    const std::uint16_t* squares = nullptr;  // index within the face, ascending
    const SquareLanes* values = nullptr;
};

// Not safe to append to while others read.
class WaveletStore {
  public:
    explicit WaveletStore(std::uint32_t n) : n_(n) {}

    // Throws std::invalid_argument when the function has another face resolution.
    void append(const SparseWavelets& function);
    // Copies what the view refers to. Its squares are in range and ascend in every face.
    void append(const WaveletView& function);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t size() const { return records_.size(); }
    [[nodiscard]] WaveletView view(std::size_t function) const;
    [[nodiscard]] std::size_t byte_count() const;
    // That one function of resolution n can add to byte_count().
    [[nodiscard]] static std::size_t most_bytes(std::uint32_t n) {
        return sizeof(Record) + basis::kFaceCount * square_count(n) *
                                    (sizeof(std::uint16_t) + sizeof(SquareLanes));
    }

  private:
    struct Record {
        std::array<float, basis::kFaceCount> scaling{};
        std::array<std::uint32_t, basis::kFaceCount + 1> first{};
        std::size_t begin = 0;
    };

    std::uint32_t n_;
    std::vector<Record> records_;
    std::vector<std::uint16_t> squares_;
    std::vector<SquareLanes> values_;
};

}  // namespace relume::tripling
