#include "precompute/bake/shrinkage.h"

#include "precompute/bake/sobol.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace relume::bake {
namespace {

// A square of 4^k texels: what falls into it, and the sum of its squares.
struct Node {
    std::uint32_t key = 0;
    Imath::V3f sum{0, 0, 0};
    float squares = 0;
};

std::vector<Node> leaves(std::vector<Contribution>& contributions) {
    std::sort(contributions.begin(), contributions.end(),
              [](const Contribution& a, const Contribution& b) { return a.texel < b.texel; });
    std::vector<Node> nodes;
    for (const Contribution& one : contributions) {
        if (nodes.empty() || nodes.back().key != one.texel) {
            nodes.push_back({.key = one.texel});
        }
        nodes.back().sum += one.value;
        nodes.back().squares += one.value.length2();
    }
    return nodes;
}

float garrote(const Imath::V3f& estimate, float variance, float standard_errors) {
    const float energy = estimate.length2();
    return energy > 0
               ? std::max(0.0F, 1 - standard_errors * standard_errors * variance / energy)
               : 0.0F;
}

class LevelWriter {
  public:
    LevelWriter(std::uint32_t face_resolution,
                std::uint32_t level,
                float standard_errors,
                std::vector<Coefficient>& coefficients)
        : face_resolution_(face_resolution),
          level_(level),
          amplitude_(static_cast<float>(1U << level) / static_cast<float>(face_resolution)),
          standard_errors_(standard_errors),
          coefficients_(coefficients) {}

    // The three wavelets over one square, given its four quarters.
    void write(std::uint32_t key, const std::array<Imath::V3f, 4>& quarter, float squares) {
        const std::uint32_t morton = key & ((1U << (2 * level_)) - 1);
        const std::uint32_t face = key >> (2 * level_);
        const std::uint32_t column = morton_even(morton);
        const std::uint32_t row = morton_even(morton >> 1U);
        const std::uint32_t side = 1U << level_;
        const auto& [p, q, r, s] = quarter;
        const float variance = squares * amplitude_ * amplitude_;
        add(face, row, column + side, (p - q + r - s) * amplitude_, variance);
        add(face, row + side, column, (p + q - r - s) * amplitude_, variance);
        add(face, row + side, column + side, (p - q - r + s) * amplitude_, variance);
    }

  private:
    void add(std::uint32_t face,
             std::uint32_t row,
             std::uint32_t column,
             const Imath::V3f& estimate,
             float variance) {
        const float kept = garrote(estimate, variance, standard_errors_);
        if (kept > 0) {
            coefficients_.push_back(
                {.index = (face * face_resolution_ + row) * face_resolution_ + column,
                 .value = estimate * kept});
        }
    }

    std::uint32_t face_resolution_;
    std::uint32_t level_;
    float amplitude_;
    float standard_errors_;
    std::vector<Coefficient>& coefficients_;
};

}  // namespace

void project_with_shrinkage(std::uint32_t face_resolution,
                            std::vector<Contribution>& contributions,
                            float standard_errors,
                            std::vector<Coefficient>& coefficients) {
    std::vector<Node> nodes = leaves(contributions);
    const auto levels = static_cast<std::uint32_t>(std::countr_zero(face_resolution));
    for (std::uint32_t level = levels; level-- > 0;) {
        LevelWriter writer(face_resolution, level, standard_errors, coefficients);
        std::size_t parents = 0;
        for (std::size_t i = 0; i < nodes.size();) {
            const std::uint32_t key = nodes[i].key >> 2U;
            std::array<Imath::V3f, 4> quarter;
            quarter.fill(Imath::V3f(0, 0, 0));  // Imath's default is no value at all
            Node parent{.key = key};
            for (; i < nodes.size() && nodes[i].key >> 2U == key; ++i) {
                quarter[nodes[i].key & 3U] = nodes[i].sum;
                parent.sum += nodes[i].sum;
                parent.squares += nodes[i].squares;
            }
            writer.write(key, quarter, parent.squares);
            nodes[parents++] = parent;
        }
        nodes.resize(parents);
    }
    for (const Node& face : nodes) {
        coefficients.push_back({.index = face.key * face_resolution * face_resolution,
                                .value = face.sum / static_cast<float>(face_resolution)});
    }
}

}  // namespace relume::bake
