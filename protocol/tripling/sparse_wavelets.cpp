#include "protocol/tripling/sparse_wavelets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace relume::tripling {
namespace {

// Where the three coefficients of a square of a cubemap lie.
std::array<std::size_t, 3> places_of_square(std::uint32_t n, std::size_t square) {
    const std::size_t stride = face_stride(n);
    const std::size_t face = square / stride;
    const WaveletSquare in_face = square_from_index(square % stride);
    std::array<std::size_t, 3> places{};
    for (std::size_t m = 0; m < places.size(); ++m) {
        places[m] = face * n * n + coefficient_from_wavelet(n, in_face, kWaveletTypes[m]);
    }
    return places;
}

template <typename Visit>
void for_each_square(std::uint32_t n, Visit visit) {
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        for (std::size_t i = 0; i < square_count(n); ++i) {
            visit(static_cast<std::uint32_t>(face * face_stride(n) + i));
        }
    }
}

struct RankedSquare {
    double weight = 0;
    std::uint32_t square = 0;

    // Heavier ones first, and of equal ones the first: one order on every machine.
    friend bool operator<(const RankedSquare& a, const RankedSquare& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.square < b.square;
    }
};

}  // namespace

SparseWavelets::SparseWavelets(const SquareSet& kept, std::span<const float> coefficients)
    : squares_(kept) {
    const std::uint32_t n = face_resolution();
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        scaling_[face] = coefficients[face * n * n];
    }
    values_.reserve(squares_.size());
    squares_.for_each([&](std::size_t square) {
        const auto places = places_of_square(n, square);
        values_.push_back(
            {coefficients[places[0]], coefficients[places[1]], coefficients[places[2]]});
    });
}

SparseWavelets::SparseWavelets(SquareSet kept,
                               const std::array<float, basis::kFaceCount>& scaling,
                               std::vector<SquareCoefficients> values)
    : squares_(std::move(kept)), scaling_(scaling), values_(std::move(values)) {}

std::size_t SparseWavelets::nonzero_count() const {
    std::size_t count = 0;
    for (const SquareCoefficients& square : values_) {
        count += static_cast<std::size_t>(
            std::count_if(square.begin(), square.end(), [](float c) { return c != 0; }));
    }
    return count;
}

std::vector<float> SparseWavelets::coefficients() const {
    const std::uint32_t n = face_resolution();
    std::vector<float> all(std::size_t{basis::kFaceCount} * n * n, 0);
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        all[face * n * n] = scaling_[face];
    }
    auto value = values_.begin();
    squares_.for_each([&](std::size_t square) {
        const auto places = places_of_square(n, square);
        for (std::size_t m = 0; m < places.size(); ++m) {
            all[places[m]] = (*value)[m];
        }
        ++value;
    });
    return all;
}

SquareSet nonzero_squares(std::uint32_t n, std::span<const float> coefficients) {
    std::vector<std::uint32_t> squares;
    for_each_square(n, [&](std::uint32_t square) {
        const auto places = places_of_square(n, square);
        if (std::any_of(places.begin(), places.end(),
                        [&](std::size_t place) { return coefficients[place] != 0; })) {
            squares.push_back(square);
        }
    });
    return {n, squares};
}

SquareSet largest_squares(std::uint32_t n,
                          std::span<const float> coefficients,
                          std::size_t term_count,
                          TermOrder order) {
    std::vector<RankedSquare> wavelets;  // a square three times, once a wavelet
    for_each_square(n, [&](std::uint32_t square) {
        const double area = order == TermOrder::by_area
                                ? std::exp2(-1.0 * level_from_square(square % face_stride(n)))
                                : 1;
        for (const std::size_t place : places_of_square(n, square)) {
            wavelets.push_back({area * std::abs(double{coefficients[place]}), square});
        }
    });
    const std::size_t kept = std::min(term_count, wavelets.size());
    std::partial_sort(wavelets.begin(), wavelets.begin() + static_cast<std::ptrdiff_t>(kept),
                      wavelets.end());
    std::vector<std::uint32_t> squares;
    for (std::size_t i = 0; i < kept && wavelets[i].weight > 0; ++i) {
        squares.push_back(wavelets[i].square);
    }
    return {n, squares};
}

SquareSet squares_of_energy(std::uint32_t n,
                            std::span<const float> coefficients,
                            double energy_fraction) {
    double kept_energy = 0;
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        const double scaling = coefficients[face * n * n];
        kept_energy += scaling * scaling;
    }
    double energy = kept_energy;
    std::vector<double> energy_of(square_stride(n), 0);
    std::vector<RankedSquare> ranked;
    for_each_square(n, [&](std::uint32_t square) {
        for (const std::size_t place : places_of_square(n, square)) {
            energy_of[square] += double{coefficients[place]} * double{coefficients[place]};
        }
        energy += energy_of[square];
        ranked.push_back({energy_of[square], square});
    });
    std::sort(ranked.begin(), ranked.end());
    std::vector<bool> is_kept(square_stride(n), false);
    std::vector<std::uint32_t> squares;
    const auto keep = [&](std::size_t square) {
        if (!is_kept[square]) {
            is_kept[square] = true;
            kept_energy += energy_of[square];
            squares.push_back(static_cast<std::uint32_t>(square));
        }
    };
    for (const RankedSquare& next : ranked) {
        if (kept_energy >= energy_fraction * energy || next.weight == 0) {
            break;
        }
        keep(next.square);
        const std::size_t stride = face_stride(n);
        const std::size_t face = next.square / stride * stride;
        for (std::size_t within = next.square - face; within != 0;) {
            within = parent_square(within);
            keep(face + within);
        }
    }
    return {n, squares};
}

}  // namespace relume::tripling
