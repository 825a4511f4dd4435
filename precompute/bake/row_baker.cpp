#include "precompute/bake/row_baker.h"

#include "protocol/basis/haar.h"
#include "protocol/basis/cpu_clones.h"

#include <span>

namespace relume::bake {
namespace {

RELUME_CPU_CLONES void scale(std::span<const float> source,
                             float factor,
                             std::span<float> target) {
    for (std::size_t i = 0; i < source.size(); ++i) {
        target[i] = factor * source[i];
    }
}

// Response to a constant environment: a face's scaling coefficient is its sum over n.
Imath::V3f white_response(std::uint32_t n, const CoefficientRow& row) {
    Imath::V3f white{0, 0, 0};
    for (int c = 0; c < 3; ++c) {
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            white[c] += row.rgb[static_cast<std::size_t>(c)][face * n * n];
        }
    }
    return white * static_cast<float>(n);
}

}  // namespace

RowBaker::RowBaker(const RayCaster& caster,
                   const LightTexels& texels,
                   const BakeParameters& parameters)
    : face_resolution_(texels.face_resolution()),
      shrinkage_(parameters.shrinkage),
      seed_(parameters.seed),
      direct_(caster, texels, parameters.edge_samples) {}

void RowBaker::bake(const TracedPixel& pixel,
                    std::uint32_t x,
                    std::uint32_t y,
                    const PathPool* pool,
                    CoefficientRow& row,
                    Scratch& scratch) const {
    TexelRow& texels = scratch.texels;
    direct_.compute(pixel.view, x, y, seed_, texels, scratch.direct);
    if (texels.is_grey) {
        basis::haar_forward_cubemap(face_resolution_, texels.plane[0]);
        for (std::size_t c = 0; c < 3; ++c) {
            const float factor = texels.colour[static_cast<int>(c)];
            row.rgb[c].resize(texels.plane[0].size());
            scale(texels.plane[0], factor, row.rgb[c]);
        }
    } else {
        for (std::size_t c = 0; c < 3; ++c) {
            std::swap(row.rgb[c], texels.plane[c]);
            basis::haar_forward_cubemap(face_resolution_, row.rgb[c]);
        }
    }
    row.direct_white = white_response(face_resolution_, row);
    add_indirect(pixel, x, y, pool, row, scratch);
    row.white = white_response(face_resolution_, row);
}

void RowBaker::add_indirect(const TracedPixel& pixel,
                            std::uint32_t x,
                            std::uint32_t y,
                            const PathPool* pool,
                            CoefficientRow& row,
                            Scratch& scratch) const {
    for (std::uint32_t i = 0; i < pixel.paths.size(); ++i) {
        if (pool != nullptr) {
            pool->gather(x, y, i, scratch.contributions);
        } else {
            gather_own(pixel.paths[i], scratch.contributions);
        }
        scratch.coefficients.clear();
        project_with_shrinkage(face_resolution_, scratch.contributions, shrinkage_,
                               scratch.coefficients);
        const PixelSurface& surface = pixel.view.surfaces[i];
        const Imath::V3f factor =
            reflectance(surface.point.bsdf) * surface.tint * surface.share;
        for (const Coefficient& coefficient : scratch.coefficients) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto colour = static_cast<int>(c);
                row.rgb[c][coefficient.index] += factor[colour] * coefficient.value[colour];
            }
        }
    }
}

}  // namespace relume::bake
