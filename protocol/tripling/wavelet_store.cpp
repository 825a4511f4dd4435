#include "protocol/tripling/wavelet_store.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

namespace relume::tripling {

void WaveletStore::append(const SparseWavelets& function) {
    if (function.face_resolution() != n_) {
        throw std::invalid_argument("a function of face resolution " +
                                    std::to_string(function.face_resolution()) + ", expected " +
                                    std::to_string(n_));
    }
    Record record;
    std::copy(function.scaling().begin(), function.scaling().end(), record.scaling.begin());
    record.begin = squares_.size();
    function.squares().for_each([&](std::size_t square) {
        const std::size_t face = square / face_stride(n_);
        ++record.first[face + 1];
        squares_.push_back(static_cast<std::uint16_t>(square % face_stride(n_)));
    });
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        record.first[face + 1] += record.first[face];
    }
    for (const SquareCoefficients& square : function.values()) {
        values_.push_back({0, square[0], square[1], square[2]});
    }
    records_.push_back(record);
}

void WaveletStore::append(const WaveletView& function) {
    records_.push_back(
        {.scaling = function.scaling, .first = function.first, .begin = squares_.size()});
    const std::size_t count = function.first.back();
    squares_.insert(squares_.end(), function.squares, function.squares + count);
    values_.insert(values_.end(), function.values, function.values + count);
}

WaveletView WaveletStore::view(std::size_t function) const {
    const Record& record = records_[function];
    return {.scaling = record.scaling,
            .first = record.first,
            .squares = squares_.data() + record.begin,
            .values = values_.data() + record.begin};
}

std::size_t WaveletStore::byte_count() const {
    return std::as_bytes(std::span(records_)).size() +
           std::as_bytes(std::span(squares_)).size() + std::as_bytes(std::span(values_)).size();
}

}  // namespace relume::tripling
