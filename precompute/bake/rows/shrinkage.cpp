#include "precompute/bake/rows/shrinkage.h"

#include "precompute/bake/rays/sobol.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace relume::bake {
namespace {

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

void project_with_shrinkage(EscapeSum& escapes,
                            float standard_errors,
                            std::vector<Coefficient>& coefficients) {
    const std::uint32_t n = escapes.face_resolution();
    // Squares of 4^k texels lie in the order of their keys: four children follow each other,
    // and their parent is written over what has been read.
    std::span<EscapeNode> nodes = escapes.nodes();
    const auto levels = static_cast<std::uint32_t>(std::countr_zero(n));
    for (std::uint32_t level = levels; level-- > 0;) {
        LevelWriter writer(n, level, standard_errors, coefficients);
        const std::size_t parents = nodes.size() / 4;
        for (std::size_t i = 0; i < parents; ++i) {
            EscapeNode parent;
            std::array<Imath::V3f, 4> quarter;
            for (std::size_t q = 0; q < 4; ++q) {
                const EscapeNode& child = nodes[4 * i + q];
                quarter[q] = child.sum;
                parent.sum += child.sum;
                parent.squares += child.squares;
            }
            if (parent.squares > 0) {
                writer.write(static_cast<std::uint32_t>(i), quarter, parent.squares);
            }
            nodes[i] = parent;
        }
        nodes = nodes.first(parents);
    }
    for (std::uint32_t face = 0; face < nodes.size(); ++face) {
        if (nodes[face].squares > 0) {
            coefficients.push_back(
                {.index = face * n * n, .value = nodes[face].sum / static_cast<float>(n)});
        }
    }
}

}  // namespace relume::bake
