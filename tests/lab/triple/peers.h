// Ways to integrate light times visibility times material at a vertex, compared.
#pragma once

#include "protocol/tripling/square_set.h"
#include "server/engine/kernels/open_texels.h"
#include "server/engine/kernels/triple_product.h"
#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/tabulated_material.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

// Three colours of a light, 6·n² each, in the order of cubemap.h: as texels, and what the ways
// read.
class TripleLight {
  public:
    TripleLight(std::uint32_t face_resolution, std::array<std::vector<float>, 3> texels);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] const engine::LightTable& table() const { return table_; }
    [[nodiscard]] const std::array<std::vector<float>, 3>& coefficients() const {
        return coefficients_;
    }
    // Of texels in squares (texel_blocks.h), and in the order of cubemap.h.
    [[nodiscard]] engine::ColourPlanes block_planes() const;
    [[nodiscard]] engine::ColourPlanes planes() const;
    // The squares of the largest wavelets of its luminance, weighted by area [Ng03 §4.1].
    [[nodiscard]] tripling::SquareSet largest(double fraction) const;

  private:
    std::uint32_t n_;
    std::array<std::vector<float>, 3> texels_;
    std::array<std::vector<float>, 3> block_texels_;
    std::array<std::vector<float>, 3> coefficients_;
    std::vector<float> luminance_;  // coefficients
    engine::LightTable table_;
};

// At the i-th of SeenSurface::seen(). A function has memory of its own: one for each thread.
using IntegrateAt = std::function<engine::Radiance(std::size_t i)>;

struct TripleWay {
    std::string name;
    std::function<IntegrateAt()> make;
};

// All arguments outlive the ways. `fraction` is an index into the fractions of the material.
//
// The sublinear algorithm in the engine's kernels.
[[nodiscard]] TripleWay sublinear_way(const SeenSurface& surface,
                                      const TabulatedMaterial& material,
                                      std::size_t fraction,
                                      const TripleLight& light,
                                      const tripling::SquareSet& light_terms);
// The same as [Ng04 §5.3] publishes it: hash tables for the visibility and for parent sums,
// one number at a time.
[[nodiscard]] TripleWay published_way(const SeenSurface& surface,
                                      const TabulatedMaterial& material,
                                      std::size_t fraction,
                                      const TripleLight& light,
                                      const tripling::SquareSet& light_terms);
// Over texels in the engine's kernels: a bit a texel of visibility, runs of texels of the
// material. `texels` is TabulatedMaterial::runs(), or its texels() for the exact integral.
[[nodiscard]] TripleWay bits_way(const SeenSurface& surface,
                                 const TabulatedMaterial& material,
                                 const tripling::TexelStore& texels,
                                 const TripleLight& light);
// Visibility and material from wavelets back to texels, then over all texels.
[[nodiscard]] TripleWay decompressed_way(const SeenSurface& surface,
                                         const TabulatedMaterial& material,
                                         std::size_t fraction,
                                         const TripleLight& light);
// Over all texels, visibility and material being in memory as a float a texel; of the first
// `most` seen vertices, over and over.
[[nodiscard]] TripleWay pixels_way(const SeenSurface& surface,
                                   const TabulatedMaterial& material,
                                   const TripleLight& light,
                                   std::size_t most);

}  // namespace relume::lab
