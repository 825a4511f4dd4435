#include "protocol/tripling/visibility_wavelets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace relume::tripling {
namespace {

// What d is divided by before it is stored: 1 but for the one width whose d needs 17 bits.
std::int32_t divisor_of_level(std::uint32_t n, std::uint32_t level) {
    return n >> level == 256 ? 2 : 1;
}

template <typename Integer>
void append_value(std::vector<std::byte>& values, std::int32_t value) {
    const auto stored = static_cast<Integer>(value);
    std::array<std::byte, sizeof(Integer)> bytes{};
    std::memcpy(bytes.data(), &stored, sizeof(Integer));
    values.insert(values.end(), bytes.begin(), bytes.end());
}

// Numbers of open texels of the four quarters of every square of a face.
std::vector<std::array<std::int32_t, 4>> open_quarters(
    std::uint32_t n, std::size_t face, std::span<const std::uint64_t> open_texels) {
    std::vector<std::array<std::int32_t, 4>> quarters(square_count(n));
    for (std::size_t i = square_count(n); i-- > 0;) {
        const WaveletSquare square = square_from_index(i);
        for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
            if (first_child(i) < square_count(n)) {
                const auto& child = quarters[first_child(i) + quadrant];
                quarters[i][quadrant] = child[0] + child[1] + child[2] + child[3];
            } else {
                const std::size_t texel = (face * n + 2 * square.row + quadrant / 2) * n +
                                          2 * square.column + quadrant % 2;
                quarters[i][quadrant] = static_cast<std::int32_t>(
                    open_texels[texel / kWordBits] >> texel % kWordBits & 1U);
            }
        }
    }
    return quarters;
}

std::array<std::int32_t, 3> differences(const std::array<std::int32_t, 4>& q) {
    return {q[0] - q[1] + q[2] - q[3], q[0] + q[1] - q[2] - q[3], q[0] - q[1] - q[2] + q[3]};
}

}  // namespace

VisibilityWavelets::VisibilityWavelets(std::uint32_t n) : n_(n) {}

void VisibilityWavelets::append(std::span<const std::uint64_t> open_texels) {
    const std::size_t stride = face_stride(n_);
    const std::size_t first_word = words_.size();
    words_.resize(first_word + word_count(n_), 0);
    ranks_.resize(words_.size(), 0);
    first_value_.push_back(values_.size());
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        VisibleFace visible;
        visible.first_byte = static_cast<std::uint32_t>(values_.size() - first_value_.back());
        std::uint16_t rank = 0;
        const auto quarters = open_quarters(n_, face, open_texels);
        if (n_ == 1) {
            visible.scaling = static_cast<float>(open_texels[0] >> face & 1U);
        } else {
            const auto& root = quarters[0];
            visible.scaling = static_cast<float>(root[0] + root[1] + root[2] + root[3]) /
                              static_cast<float>(n_);
        }
        for (std::size_t i = 0; i < quarters.size(); ++i) {
            const std::size_t word = first_word + (face * stride + i) / kWordBits;
            if (i % kWordBits == 0) {
                ranks_[word] = rank;
            }
            const auto d = differences(quarters[i]);
            const auto nonzero =
                std::count_if(d.begin(), d.end(), [](auto v) { return v != 0; });
            if (nonzero == 0) {
                continue;
            }
            nonzero_count_ += static_cast<std::size_t>(nonzero);
            words_[word] |= std::uint64_t{1} << i % kWordBits;
            ++rank;
            const std::uint32_t level = level_from_square(i);
            const bool is_narrow = level >= first_narrow_level(n_);
            visible.wide_count += is_narrow ? 0 : 1;
            for (const std::int32_t value : d) {
                if (is_narrow) {
                    append_value<std::int8_t>(values_, value);
                } else {
                    append_value<std::int16_t>(values_, value / divisor_of_level(n_, level));
                }
            }
        }
        faces_.push_back(visible);
    }
}

VisibilityView VisibilityWavelets::point(std::size_t point) const {
    return {.words = words_.data() + point * word_count(n_),
            .ranks = ranks_.data() + point * word_count(n_),
            .faces = faces_.data() + point * basis::kFaceCount,
            .values = values_.data() + first_value_[point]};
}

SparseWavelets VisibilityWavelets::sparse(std::size_t point) const {
    const VisibilityView view = this->point(point);
    std::vector<std::uint32_t> squares;
    for (std::size_t square = 0; square < square_stride(n_); ++square) {
        if ((view.words[square / kWordBits] >> square % kWordBits & 1U) != 0) {
            squares.push_back(static_cast<std::uint32_t>(square));
        }
    }
    std::array<float, basis::kFaceCount> scaling{};
    for (std::size_t face = 0; face < scaling.size(); ++face) {
        scaling[face] = view.faces[face].scaling;
    }
    std::vector<SquareCoefficients> values;
    for (const std::uint32_t square : squares) {
        SquareCoefficients& coefficients = values.emplace_back();
        read_visible_square(n_, view, square / face_stride(n_), square % face_stride(n_),
                            coefficients.data());
    }
    return {SquareSet(n_, squares), scaling, std::move(values)};
}

std::size_t VisibilityWavelets::byte_count() const {
    return std::as_bytes(std::span(words_)).size() + std::as_bytes(std::span(ranks_)).size() +
           std::as_bytes(std::span(faces_)).size() +
           std::as_bytes(std::span(first_value_)).size() + values_.size();
}

}  // namespace relume::tripling
