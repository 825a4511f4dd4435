#include "protocol/tripling/texel_store.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::tripling {
namespace {

std::span<const float> run_of(std::span<const float> texels, std::size_t run) {
    const std::size_t first = run * kRunTexels;
    return texels.subspan(first, std::min(kRunTexels, texels.size() - first));
}

}  // namespace

void TexelStore::append(std::span<const float> texels, double left_off) {
    std::vector<double> sums(run_count(n_));
    for (std::size_t run = 0; run < sums.size(); ++run) {
        for (const float value : run_of(texels, run)) {
            sums[run] += std::abs(double{value});
        }
    }
    std::vector<std::size_t> order(sums.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sums[a] < sums[b]; });
    const double most = left_off * std::accumulate(sums.begin(), sums.end(), 0.0);
    std::vector<bool> is_kept(sums.size(), true);
    double dropped = 0;
    for (const std::size_t run : order) {
        dropped += sums[run];
        if (dropped > most) {
            break;
        }
        is_kept[run] = false;
    }
    first_value_.push_back(values_.size());
    const std::size_t first_word = words_.size();
    words_.resize(first_word + run_word_count(n_), 0);
    ranks_.resize(words_.size(), 0);
    std::uint16_t rank = 0;
    for (std::size_t run = 0; run < sums.size(); ++run) {
        if (run % 64 == 0) {
            ranks_[first_word + run / 64] = rank;
        }
        if (is_kept[run]) {
            words_[first_word + run / 64] |= std::uint64_t{1} << run % 64;
            ++rank;
            const auto of_run = run_of(texels, run);
            values_.insert(values_.end(), of_run.begin(), of_run.end());
            values_.resize(first_value_.back() + std::size_t{rank} * kRunTexels, 0.0F);
        }
    }
}

TexelView TexelStore::view(std::size_t function) const {
    return {.words = words_.data() + function * run_word_count(n_),
            .ranks = ranks_.data() + function * run_word_count(n_),
            .values = values_.data() + first_value_[function]};
}

std::vector<float> TexelStore::texels(std::size_t function) const {
    std::vector<float> all(run_count(n_) * kRunTexels, 0.0F);
    for (std::size_t run = 0; run < run_count(n_); ++run) {
        if (const float* values = values_of_run(view(function), run)) {
            std::copy(values, values + kRunTexels, &all[run * kRunTexels]);
        }
    }
    all.resize(basis::texel_count(n_));
    return all;
}

std::size_t TexelStore::byte_count() const {
    return std::as_bytes(std::span(words_)).size() + std::as_bytes(std::span(ranks_)).size() +
           std::as_bytes(std::span(first_value_)).size() +
           std::as_bytes(std::span(values_)).size();
}

}  // namespace relume::tripling
