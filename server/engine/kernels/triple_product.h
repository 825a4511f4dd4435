// The triple product integral of one receiver [Ng04 §5.3]: light times visibility times
// material, from the wavelets of the material and of the light that are kept.
//
// It is made in two halves. The first multiplies visibility and material and gives a short list
// of products, a vector a wavelet square; the second sums them with the light. The list does
// not depend on the light's values: while a view rests it is the receiver's row of transport.
#pragma once

#include "protocol/tripling/visibility_wavelets.h"
#include "protocol/tripling/wavelet_store.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// A material at a receiver is a sum of a few tabulated functions.
struct WeightedWavelets {
    float weight = 0;
    tripling::WaveletView function;
};

// What the two factors make of a square: lane 0 goes with the light's mean over the square, the
// others with its three wavelets.
using ProductLanes = std::array<float, 4>;

// What the first half leaves, with the memory that it needs meanwhile: one for each thread,
// used for one receiver after another.
class TripleWorkspace {
  public:
    // Of cubemaps of resolution n, a power of two from 4 to 256.
    explicit TripleWorkspace(std::uint32_t n);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    // Squares of the cubemap (square_set.h) and their products; a square may come twice.
    [[nodiscard]] std::span<const std::uint32_t> squares() const {
        return {squares_.data(), count_};
    }
    [[nodiscard]] std::span<const ProductLanes> products() const {
        return {products_.data(), count_};
    }

    // The rest is for the kernels. Of one face, by a square's index in it:
    struct Face {
        std::vector<ProductLanes> material;  // kept coefficients; zero between receivers
        std::vector<float> material_means;   // parent sums over the amplitude of the square
        std::vector<float> visible_means;    // the same of the visibility
        std::vector<std::uint64_t> kept;     // squares of the material; zero between receivers
    };
    [[nodiscard]] Face& face() { return face_; }
    void clear() { count_ = 0; }
    void append(std::size_t square, const float* product) {
        squares_[count_] = static_cast<std::uint32_t>(square);
        products_[count_] = {product[0], product[1], product[2], product[3]};
        ++count_;
    }

  private:
    std::uint32_t n_;
    std::size_t count_ = 0;
    Face face_;
    std::vector<std::uint32_t> squares_;
    std::vector<ProductLanes> products_;
};

// The light as the second half reads it: for each square of the cubemap the mean over the
// square (its parent sum over the amplitude) and its three wavelets, each in red, green, blue
// and 0, all times the amplitude of the square's level.
class LightTable {
  public:
    // Zero light of cubemaps of resolution n.
    explicit LightTable(std::uint32_t n);

    // Coefficients of the mean radiance of texels in three colours, 6·n² each in the order of
    // haar.h. Takes time that is linear in n².
    void set(const std::array<std::span<const float>, 3>& coefficients);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    // [square][lane][colour]
    [[nodiscard]] const float* row(std::size_t square) const { return &rows_[16 * square]; }
    [[nodiscard]] const float* rows() const { return rows_.data(); }

  private:
    std::uint32_t n_;
    std::vector<float> rows_;
};

using Radiance = std::array<float, 3>;

// First half: fills the workspace's list for a receiver of `visibility` and the sum of
// `material`, as far as the terms of sublinear_integral.h go, `light_terms` being the words of
// a SquareSet. The functions' squares include all their ancestors; all have the workspace's
// resolution. Products of the same bits on every instruction set: every sum in one order, with
// fused multiply-adds.
void multiply_visibility(const tripling::VisibilityView& visibility,
                         std::span<const WeightedWavelets> material,
                         std::span<const std::uint64_t> light_terms,
                         TripleWorkspace& workspace);

// Second half: Σ over the list of light times product. Even and odd places of the list are
// added up by themselves, and each of the four lanes; then (even + odd), and lanes as (0 + 1) +
// (2 + 3).
[[nodiscard]] Radiance sum_light(const LightTable& light, const TripleWorkspace& workspace);

// The specifications: one value at a time.
void multiply_visibility_scalar(const tripling::VisibilityView& visibility,
                                std::span<const WeightedWavelets> material,
                                std::span<const std::uint64_t> light_terms,
                                TripleWorkspace& workspace);
[[nodiscard]] Radiance sum_light_scalar(const LightTable& light,
                                        const TripleWorkspace& workspace);

}  // namespace relume::engine
