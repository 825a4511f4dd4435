#include "protocol/tripling/sublinear_integral.h"

#include <array>

namespace relume::tripling {

double LazyParentSums::at(std::size_t square) {
    if (const auto found = known_.find(square); found != known_.end()) {
        return found->second;
    }
    const std::uint32_t n = function_.face_resolution();
    const std::size_t stride = face_stride(n);
    const std::size_t face = square / stride;
    const std::size_t within = square % stride;
    double sum = 0;
    if (within == 0) {
        sum = amplitude(n, 0) * double{function_.scaling()[face]};
    } else {
        const std::size_t parent = parent_square(within);
        const SquareCoefficients wavelets = function_.at(face * stride + parent);
        const auto& signs = kQuadrantSigns[quadrant_in_parent(within)];
        for (std::size_t m = 0; m < wavelets.size(); ++m) {
            sum += signs[m] * double{wavelets[m]};
        }
        sum = at(face * stride + parent) + amplitude(n, level_from_square(parent)) * sum;
    }
    known_.emplace(square, sum);
    return sum;
}

double sublinear_triple_integral(const SparseWavelets& light,
                                 const SquareSet& light_terms,
                                 const SparseWavelets& visibility,
                                 const SparseWavelets& material) {
    const std::uint32_t n = light.face_resolution();
    LazyParentSums light_sums(light);
    LazyParentSums visibility_sums(visibility);
    LazyParentSums material_sums(material);
    double integral = 0;
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        integral += amplitude(n, 0) * double{light.scaling()[face]} *
                    double{visibility.scaling()[face]} * double{material.scaling()[face]};
    }
    material.squares().for_each([&](std::size_t square) {
        const SquareCoefficients l = light.at(square);
        const SquareCoefficients v = visibility.at(square);
        const SquareCoefficients p = material.at(square);
        const double size = amplitude(n, level_from_square(square % face_stride(n)));
        const double light_sum = light_sums.at(square);
        const double visibility_sum = visibility_sums.at(square);
        for (std::size_t m = 0; m < p.size(); ++m) {
            const std::size_t next = (m + 1) % 3;
            const std::size_t last = (m + 2) % 3;
            integral +=
                double{p[m]} * (size * (double{l[next]} * double{v[last]} +
                                        double{l[last]} * double{v[next]}) +
                                double{l[m]} * visibility_sum + double{v[m]} * light_sum);
        }
    });
    light_terms.for_each([&](std::size_t square) {
        if (!visibility.squares().contains(square)) {
            return;
        }
        const SquareCoefficients l = light.at(square);
        const SquareCoefficients v = visibility.at(square);
        const double material_sum = material_sums.at(square);
        for (std::size_t m = 0; m < l.size(); ++m) {
            integral += double{v[m]} * double{l[m]} * material_sum;
        }
    });
    return integral;
}

}  // namespace relume::tripling
