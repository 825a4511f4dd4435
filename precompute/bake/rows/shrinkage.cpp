#include "precompute/bake/rows/shrinkage.h"

#include "protocol/sampling/sobol.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace relume::bake {
namespace {

// Squares that are shrunk together: the four of one parent.
constexpr std::size_t kTogether = 4;

// A square of one level, while it is added up from its quarters.
struct Square {
    std::array<Imath::V3f, 4> quarter;
    EscapeNode whole;

    explicit Square(std::span<const EscapeNode, 4> children) {
        for (std::size_t q = 0; q < quarter.size(); ++q) {
            quarter[q] = children[q].sum;
            whole.sum += children[q].sum;
            whole.squares += children[q].squares;
        }
    }
    // Of its three wavelets, over their common squared amplitude (Parseval).
    [[nodiscard]] float detail_energy() const {
        float quarters = 0;
        for (const Imath::V3f& one : quarter) {
            quarters += one.length2();
        }
        return 4 * quarters - whole.sum.length2();
    }
};

float garrote(float energy, float variance, float standard_errors) {
    return energy > 0
               ? std::max(0.0F, 1 - standard_errors * standard_errors * variance / energy)
               : 0.0F;
}

class LevelWriter {
  public:
    LevelWriter(std::uint32_t face_resolution,
                std::uint32_t level,
                std::vector<Coefficient>& coefficients)
        : face_resolution_(face_resolution),
          level_(level),
          amplitude_(static_cast<float>(1U << level) / static_cast<float>(face_resolution)),
          coefficients_(coefficients) {}

    // The three wavelets over one square, times `kept` > 0.
    void write(std::uint32_t key, const Square& square, float kept) {
        const std::uint32_t morton = key & ((1U << (2 * level_)) - 1);
        const std::uint32_t face = key >> (2 * level_);
        const std::uint32_t column = sampling::morton_even(morton);
        const std::uint32_t row = sampling::morton_even(morton >> 1U);
        const std::uint32_t side = 1U << level_;
        const auto& [p, q, r, s] = square.quarter;
        const float scale = amplitude_ * kept;
        add(face, row, column + side, (p - q + r - s) * scale);
        add(face, row + side, column, (p + q - r - s) * scale);
        add(face, row + side, column + side, (p - q - r + s) * scale);
    }

  private:
    void add(std::uint32_t face,
             std::uint32_t row,
             std::uint32_t column,
             const Imath::V3f& value) {
        coefficients_.push_back(
            {.index = (face * face_resolution_ + row) * face_resolution_ + column,
             .value = value});
    }

    std::uint32_t face_resolution_;
    std::uint32_t level_;
    float amplitude_;
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
    thread_local std::vector<Square> group;
    const auto levels = static_cast<std::uint32_t>(std::countr_zero(n));
    for (std::uint32_t level = levels; level-- > 0;) {
        LevelWriter writer(n, level, coefficients);
        const std::size_t parents = nodes.size() / 4;
        // At the top each square is a face of its own.
        const std::size_t together = level > 0 ? kTogether : 1;
        for (std::size_t first = 0; first < parents; first += together) {
            std::vector<Square>& squares = group;
            squares.clear();
            float energy = 0;
            float variance = 0;
            for (std::size_t i = first; i < first + together; ++i) {
                const Square& square = squares.emplace_back(nodes.subspan(4 * i).first<4>());
                nodes[i] = square.whole;
                energy += square.detail_energy();
                variance += 3 * square.whole.squares;
            }
            const float kept = garrote(energy, variance, standard_errors);
            for (std::size_t i = 0; i < together && kept > 0; ++i) {
                if (squares[i].whole.squares > 0) {
                    writer.write(static_cast<std::uint32_t>(first + i), squares[i], kept);
                }
            }
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
