#include "protocol/tripling/square_set.h"

namespace relume::tripling {

SquareSet::SquareSet(std::uint32_t n) : SquareSet(n, {}) {}

SquareSet::SquareSet(std::uint32_t n, std::span<const std::uint32_t> squares)
    : n_(n), words_(word_count(n), 0), ranks_(word_count(n), 0) {
    for (const std::size_t square : squares) {
        words_[square / kWordBits] |= std::uint64_t{1} << square % kWordBits;
    }
    count();
}

void SquareSet::count() {
    size_ = 0;
    for (std::size_t word = 0; word < words_.size(); ++word) {
        ranks_[word] = static_cast<std::uint32_t>(size_);
        size_ += static_cast<std::size_t>(std::popcount(words_[word]));
    }
}

SquareSet SquareSet::with_ancestors() const {
    SquareSet closed = *this;
    for_each([&](std::size_t square) {
        const std::size_t stride = face_stride(n_);
        const std::size_t face = square / stride * stride;
        for (std::size_t within = square - face; within != 0;) {
            within = parent_square(within);
            const std::size_t ancestor = face + within;
            closed.words_[ancestor / kWordBits] |= std::uint64_t{1} << ancestor % kWordBits;
        }
    });
    closed.count();
    return closed;
}

}  // namespace relume::tripling
