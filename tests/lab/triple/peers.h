// Ways to integrate light times visibility times material at a vertex, compared.
#pragma once

#include "protocol/tripling/square_set.h"
#include "server/engine/kernels/open_texels.h"
#include "server/engine/kernels/triple_product.h"
#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/tabulated_material.h"
#include "tests/lab/triple/triple_light.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

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
// The same of other vertices than the surface's own: i counts those.
[[nodiscard]] TripleWay sublinear_way_at(const SeenSurface& surface,
                                         std::span<const SeenVertex> seen,
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
