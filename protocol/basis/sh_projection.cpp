#include "protocol/basis/sh_projection.h"

#include "protocol/basis/cpu_clones.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::basis {
namespace {

constexpr std::uint32_t kLeastCellsPerSide = 64;
constexpr unsigned kPointsPerCell = 4;

// Points and weights of Gauss's rule on [0, 1] cut into `cells`.
struct Rule {
    std::vector<double> points;
    std::vector<double> weights;

    explicit Rule(std::uint32_t cells) {
        using Gauss = boost::math::quadrature::gauss<double, kPointsPerCell>;
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
                for (const double side : {-1.0, 1.0}) {
                    points.push_back((cell + 0.5 + 0.5 * side * Gauss::abscissa()[i]) / cells);
                    weights.push_back(0.5 * Gauss::weights()[i] / cells);
                }
            }
        }
    }
};

// Means of all functions over a texel.
std::vector<double> means_over_texel(const CubemapBasis& basis,
                                     const Texel& texel,
                                     const Rule& rule) {
    std::vector<double> values(basis.coefficient_count());
    std::vector<double> sums(basis.coefficient_count());
    double total = 0;
    const Imath::V3d middle(cube_point_from_face_point({texel.face, 0, 0}));
    const Imath::V3d along_u =
        Imath::V3d(cube_point_from_face_point({texel.face, 1, 0})) - middle;
    const Imath::V3d along_v =
        Imath::V3d(cube_point_from_face_point({texel.face, 0, 1})) - middle;
    const double width = 2.0 / basis.face_resolution();
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
        const double v = (texel.row + rule.points[i]) * width - 1;
        for (std::size_t j = 0; j < rule.points.size(); ++j) {
            const double u = (texel.column + rule.points[j]) * width - 1;
            const Imath::V3d on_cube = middle + along_u * u + along_v * v;
            const double distance = on_cube.length();
            // dω = du dv / distance³
            const double weight =
                rule.weights[i] * rule.weights[j] / (distance * distance * distance);
            evaluate_sh(basis.order(), on_cube / distance, values);
            for (std::size_t k = 0; k < sums.size(); ++k) {
                sums[k] += weight * values[k];
            }
            total += weight;
        }
    }
    for (double& sum : sums) {
        sum /= total;
    }
    return sums;
}

// From the values of mirror images to their sums with the signs of every parity.
void add_with_signs(std::array<float, 8>& values) {
    for (const std::size_t mirror : {1U, 2U, 4U}) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if ((i & mirror) == 0) {
                const float plus = values[i] + values[i | mirror];
                values[i | mirror] = values[i] - values[i | mirror];
                values[i] = plus;
            }
        }
    }
}

RELUME_CPU_CLONES void add_scaled(std::span<const float> source,
                                  float factor,
                                  std::span<float> target) {
    for (std::size_t i = 0; i < source.size(); ++i) {
        target[i] += factor * source[i];
    }
}

}  // namespace

ShProjection::ShProjection(const CubemapBasis& harmonics)
    : CubemapProjection(harmonics), by_parity_(harmonics.coefficient_count()) {
    std::iota(by_parity_.begin(), by_parity_.end(), 0U);
    std::stable_sort(
        by_parity_.begin(), by_parity_.end(),
        [](std::uint32_t a, std::uint32_t b) { return sh_parity(a) < sh_parity(b); });
    for (const std::uint32_t coefficient : by_parity_) {
        ++first_[sh_parity(coefficient) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());

    const std::uint32_t n = harmonics.face_resolution();
    const Rule rule(std::max(1U, kLeastCellsPerSide / n));
    for (std::size_t index = 0; index < texel_count(n); ++index) {
        const Texel texel = texel_from_index(n, index);
        const Imath::V3f direction = direction_from_texel(n, texel);
        if (direction.x < 0 || direction.y < 0 || direction.z < 0) {
            continue;
        }
        OctantTexel& images = octant_.emplace_back();
        for (std::uint32_t mirror = 0; mirror < kMirrors; ++mirror) {
            Imath::V3f mirrored = direction;
            for (int axis = 0; axis < 3; ++axis) {
                mirrored[axis] *= (mirror >> axis & 1) != 0 ? -1.0F : 1.0F;
            }
            images.index[mirror] = static_cast<std::uint32_t>(
                index_from_texel(n, texel_from_direction(n, mirrored)));
        }
        images.solid_angle_sr =
            static_cast<float>(basis::solid_angle_sr(n, texel.row, texel.column));
        const std::vector<double> means = means_over_texel(harmonics, texel, rule);
        for (const std::uint32_t coefficient : by_parity_) {
            means_.push_back(static_cast<float>(means[coefficient]));
        }
    }
}

std::span<const float> ShProjection::means(std::size_t octant_texel,
                                           std::uint32_t parity) const {
    return std::span(means_).subspan(octant_texel * by_parity_.size() + first_[parity],
                                     first_[parity + 1] - first_[parity]);
}

template <typename Weight>
void ShProjection::project(std::span<const float> texels,
                           std::span<float> coefficients,
                           Weight weight) const {
    thread_local std::vector<float> sums;
    sums.assign(by_parity_.size(), 0.0F);
    for (std::size_t i = 0; i < octant_.size(); ++i) {
        std::array<float, kMirrors> values;
        for (std::uint32_t mirror = 0; mirror < kMirrors; ++mirror) {
            values[mirror] = texels[octant_[i].index[mirror]] * weight(octant_[i]);
        }
        add_with_signs(values);
        for (std::uint32_t parity = 0; parity < kMirrors; ++parity) {
            add_scaled(means(i, parity), values[parity],
                       std::span(sums).subspan(first_[parity]));
        }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
        coefficients[by_parity_[k]] = sums[k];
    }
}

void ShProjection::project_radiance(std::span<const float> texels,
                                    std::span<float> coefficients) const {
    project(texels, coefficients,
            [](const OctantTexel& texel) { return texel.solid_angle_sr; });
}

void ShProjection::project_response(std::span<const float> texels,
                                    std::span<float> coefficients) const {
    project(texels, coefficients, [](const OctantTexel&) { return 1.0F; });
}

void ShProjection::reconstruct_radiance(std::span<const float> coefficients,
                                        std::span<float> texels) const {
    for (std::size_t i = 0; i < octant_.size(); ++i) {
        std::array<float, kMirrors> values{};
        for (std::uint32_t parity = 0; parity < kMirrors; ++parity) {
            const std::span<const float> of_parity = means(i, parity);
            for (std::size_t k = 0; k < of_parity.size(); ++k) {
                values[parity] += of_parity[k] * coefficients[by_parity_[first_[parity] + k]];
            }
        }
        add_with_signs(values);
        for (std::uint32_t mirror = 0; mirror < kMirrors; ++mirror) {
            texels[octant_[i].index[mirror]] = values[mirror];
        }
    }
}

}  // namespace relume::basis
