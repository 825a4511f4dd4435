// A set of wavelet squares of a cubemap, in which a square is found and counted in constant
// time: a bit a square, and the number of squares before each word of bits.
//
// Squares of a cubemap are numbered face by face, each face from a multiple of 64 on:
// face·face_stride(n) + index of wavelet_square.h. Bits and ranks take 1.25 bits a square that
// could be there, whatever is.
#pragma once

#include "protocol/basis/cubemap.h"
#include "protocol/tripling/wavelet_square.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::tripling {

inline constexpr std::size_t kWordBits = 64;

// Numbers from one face to the next.
[[nodiscard]] constexpr std::size_t face_stride(std::uint32_t n) {
    return (square_count(n) + kWordBits - 1) / kWordBits * kWordBits;
}
// Of all six faces.
[[nodiscard]] constexpr std::size_t square_stride(std::uint32_t n) {
    return basis::kFaceCount * face_stride(n);
}
// Words of bits of a set.
[[nodiscard]] constexpr std::size_t word_count(std::uint32_t n) {
    return square_stride(n) / kWordBits;
}

// Immutable; safe to share between threads.
class SquareSet {
  public:
    // The empty set of cubemaps of resolution n, a power of two from 1 to 256.
    explicit SquareSet(std::uint32_t n);
    // Sorted or not, repeated or not.
    SquareSet(std::uint32_t n, std::span<const std::uint32_t> squares);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool contains(std::size_t square) const {
        return (words_[square / kWordBits] >> square % kWordBits & 1U) != 0;
    }
    // How many squares of the set come before `square`: its place in an array that has an entry
    // a square of the set.
    [[nodiscard]] std::size_t rank(std::size_t square) const {
        const std::uint64_t before = (std::uint64_t{1} << square % kWordBits) - 1;
        return ranks_[square / kWordBits] +
               static_cast<std::size_t>(std::popcount(words_[square / kWordBits] & before));
    }
    [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }
    // Squares before each word.
    [[nodiscard]] std::span<const std::uint32_t> ranks() const { return ranks_; }

    // In ascending order.
    template <typename Visit>
    void for_each(Visit visit) const {
        for (std::size_t word = 0; word < words_.size(); ++word) {
            for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1) {
                visit(word * kWordBits + static_cast<std::size_t>(std::countr_zero(bits)));
            }
        }
    }

    // The set with all squares on the way from its squares to the roots.
    [[nodiscard]] SquareSet with_ancestors() const;

  private:
    void count();

    std::uint32_t n_;
    std::size_t size_ = 0;
    std::vector<std::uint64_t> words_;
    std::vector<std::uint32_t> ranks_;
};

}  // namespace relume::tripling
