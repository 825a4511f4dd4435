// The sublinear integral as [Ng04] publishes it: hash tables, one number at a time.
#pragma once

#include "protocol/basis/haar.h"
#include "protocol/tripling/square_set.h"
#include "server/engine/kernels/open_texels.h"
#include "tests/lab/triple/triple_light.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace relume::lab {

// Where the coefficients of the squares of a face are among those of haar.h.
inline std::vector<std::array<std::uint32_t, 3>> places_of_squares(std::uint32_t n) {
    std::vector<std::array<std::uint32_t, 3>> places(tripling::square_count(n));
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t m = 0; m < 3; ++m) {
            places[i][m] = static_cast<std::uint32_t>(tripling::coefficient_from_wavelet(
                n, tripling::square_from_index(i), tripling::kWaveletTypes[m]));
        }
    }
    return places;
}

// [Ng04 §5.3] with the hash tables of [Ng04 §7.1.1], for red, green and blue at a time.
class PublishedIntegral {
  public:
    using Square = std::array<float, 3>;
    using Table = std::unordered_map<std::uint32_t, Square>;

    PublishedIntegral(const TripleLight& light, const tripling::SquareSet& terms)
        : light_(light), n_(light.face_resolution()), places_(places_of_squares(n_)) {
        terms.for_each([&](std::size_t square) {
            light_terms_.push_back(static_cast<std::uint32_t>(square));
        });
    }

    engine::Radiance integrate(const std::array<float, 6>& visible_scaling,
                               const Table& visibility,
                               const std::array<float, 6>& material_scaling,
                               const Table& material) {
        visibility_ = &visibility;
        material_ = &material;
        visible_scaling_ = visible_scaling;
        material_scaling_ = material_scaling;
        visible_sums_.clear();
        material_sums_.clear();
        light_sums_.clear();
        engine::Radiance sum{};
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += visible_scaling[face] * material_scaling[face] *
                          light_.coefficients()[c][face * n_ * n_] / static_cast<float>(n_);
            }
        }
        for (const auto& [square, p] : material) {
            add_material(square, p, sum);
        }
        for (const std::uint32_t square : light_terms_) {
            const auto found = visibility.find(square);
            if (found == visibility.end()) {
                continue;
            }
            const float mean = parent_sum(material, material_scaling_, material_sums_, square);
            for (std::size_t c = 0; c < 3; ++c) {
                const Square l = light_square(c, square);
                for (std::size_t m = 0; m < 3; ++m) {
                    sum[c] += found->second[m] * l[m] * mean;
                }
            }
        }
        return sum;
    }

  private:
    using Sums = std::unordered_map<std::uint32_t, float>;

    [[nodiscard]] std::size_t within(std::uint32_t square) const {
        return square % tripling::face_stride(n_);
    }
    [[nodiscard]] std::size_t face(std::uint32_t square) const {
        return square / tripling::face_stride(n_);
    }
    [[nodiscard]] Square light_square(std::size_t colour, std::uint32_t square) const {
        const auto& places = places_[within(square)];
        const float* of_face = &light_.coefficients()[colour][face(square) * n_ * n_];
        return {of_face[places[0]], of_face[places[1]], of_face[places[2]]};
    }
    // Value over the square of all coarser functions, remembered.
    float parent_sum(const Table& table,
                     const std::array<float, 6>& scaling,
                     Sums& known,
                     std::uint32_t square) {
        const auto found = known.find(square);
        if (found != known.end()) {
            return found->second;
        }
        const std::size_t in_face = within(square);
        float sum = 0;
        if (in_face == 0) {
            sum = scaling[face(square)] / static_cast<float>(n_);
        } else {
            const auto parent =
                static_cast<std::uint32_t>(square - in_face + tripling::parent_square(in_face));
            sum = parent_sum(table, scaling, known, parent);
            const auto values = table.find(parent);
            if (values != table.end()) {
                sum += signed_sum(in_face, values->second);
            }
        }
        known.emplace(square, sum);
        return sum;
    }
    [[nodiscard]] float signed_sum(std::size_t in_face, const Square& of_parent) const {
        const std::size_t parent = tripling::parent_square(in_face);
        const auto& signs = tripling::kQuadrantSigns[tripling::quadrant_in_parent(in_face)];
        float sum = 0;
        for (std::size_t m = 0; m < 3; ++m) {
            sum += static_cast<float>(signs[m]) * of_parent[m];
        }
        return sum *
               static_cast<float>(tripling::amplitude(n_, tripling::level_from_square(parent)));
    }
    Square light_parent_sum(std::uint32_t square) {
        const auto found = light_sums_.find(square);
        if (found != light_sums_.end()) {
            return found->second;
        }
        const std::size_t in_face = within(square);
        Square sum{};
        if (in_face == 0) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] =
                    light_.coefficients()[c][face(square) * n_ * n_] / static_cast<float>(n_);
            }
        } else {
            const auto parent =
                static_cast<std::uint32_t>(square - in_face + tripling::parent_square(in_face));
            sum = light_parent_sum(parent);
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += signed_sum(in_face, light_square(c, parent));
            }
        }
        light_sums_.emplace(square, sum);
        return sum;
    }
    void add_material(std::uint32_t square, const Square& p, engine::Radiance& sum) {
        const auto found = visibility_->find(square);
        const Square v = found == visibility_->end() ? Square{} : found->second;
        const float visible = parent_sum(*visibility_, visible_scaling_, visible_sums_, square);
        const Square of_light = light_parent_sum(square);
        const auto size = static_cast<float>(
            tripling::amplitude(n_, tripling::level_from_square(within(square))));
        for (std::size_t c = 0; c < 3; ++c) {
            const Square l = light_square(c, square);
            sum[c] += size *
                      (p[0] * (l[1] * v[2] + l[2] * v[1]) + p[1] * (l[2] * v[0] + l[0] * v[2]) +
                       p[2] * (l[0] * v[1] + l[1] * v[0]));
            for (std::size_t m = 0; m < 3; ++m) {
                sum[c] += p[m] * (l[m] * visible + v[m] * of_light[c]);
            }
        }
    }

    const TripleLight& light_;
    std::uint32_t n_;
    std::vector<std::array<std::uint32_t, 3>> places_;
    std::vector<std::uint32_t> light_terms_;
    const Table* visibility_ = nullptr;
    const Table* material_ = nullptr;
    std::array<float, 6> visible_scaling_{};
    std::array<float, 6> material_scaling_{};
    Sums visible_sums_;
    Sums material_sums_;
    std::unordered_map<std::uint32_t, Square> light_sums_;
};

}  // namespace relume::lab
