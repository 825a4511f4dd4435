// Many functions on cubemaps of one resolution by their texels, as far as they are not nearly
// zero: a highlight fills a small part of the sphere.
//
// Texels are kept in *runs* of 64, texels 64·i … 64·i + 63 of whatever order they come in, with
// a bit a run that is there and a count of the runs before each word of bits. In squares of 8×8
// (texel_blocks.h) a highlight fills the fewest runs.
#pragma once

#include "protocol/basis/cubemap.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::tripling {

inline constexpr std::size_t kRunTexels = 64;

// Of a cubemap; the last run of n = 4 has 32 texels beyond the cubemap's, which are zero.
[[nodiscard]] constexpr std::size_t run_count(std::uint32_t n) {
    return (basis::texel_count(n) + kRunTexels - 1) / kRunTexels;
}
// Words with a bit a run.
[[nodiscard]] constexpr std::size_t run_word_count(std::uint32_t n) {
    return (run_count(n) + 63) / 64;
}

// One function of a store, which it refers to.
struct TexelView {
    const std::uint64_t* words = nullptr;  // [run_word_count(n)], a bit a run that is kept
    const std::uint16_t* ranks = nullptr;  // [run_word_count(n)], runs kept before it
    const float* values = nullptr;         // 64 a run that is kept
};

// The 64 values of a run; null where the function has none.
[[nodiscard]] inline const float* values_of_run(const TexelView& function, std::size_t run) {
    const std::uint64_t kept = function.words[run / 64];
    const std::uint64_t bit = std::uint64_t{1} << run % 64;
    if ((kept & bit) == 0) {
        return nullptr;
    }
    const auto before = static_cast<std::size_t>(std::popcount(kept & (bit - 1)));
    return function.values + kRunTexels * (function.ranks[run / 64] + before);
}

// Not safe to append to while others read.
class TexelStore {
  public:
    // Of cubemaps of resolution n, a power of two from 4 to 256.
    explicit TexelStore(std::uint32_t n) : n_(n) {}

    // At least 6·n² texels, what follows being zero. Leaves off the runs with the least sums of
    // absolute values, as long as what is left off is at most `left_off` of the sum of all.
    void append(std::span<const float> texels, double left_off);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t size() const { return first_value_.size(); }
    [[nodiscard]] TexelView view(std::size_t function) const;
    // [6·n²], zeros where nothing is kept.
    [[nodiscard]] std::vector<float> texels(std::size_t function) const;
    [[nodiscard]] std::size_t byte_count() const;

  private:
    std::uint32_t n_;
    std::vector<std::uint64_t> words_;
    std::vector<std::uint16_t> ranks_;
    std::vector<std::size_t> first_value_;  // of each function
    std::vector<float> values_;
};

}  // namespace relume::tripling
