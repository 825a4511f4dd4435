#include "precompute/bake/rows/row_baker.h"

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

}  // namespace

RowBaker::RowBaker(const RayCaster& caster,
                   const LightTexels& texels,
                   const BakeParameters& parameters)
    : projection_(basis::CubemapProjection::onto(signal_basis(parameters))),
      escapes_(EscapeProjection::onto(projection_, parameters.shrinkage)),
      constant_light_(projection_->basis().constant_light()),
      seed_(parameters.seed),
      direct_(caster, texels, parameters.edge_samples) {}

void RowBaker::bake(const TracedReceiver& traced,
                    const PathPool* pool,
                    CoefficientRow& row,
                    Scratch& scratch) const {
    TexelRow& texels = scratch.texels;
    direct_.compute(traced.receiver, seed_, texels, scratch.direct);
    const std::size_t count = projection_->basis().coefficient_count();
    for (auto& plane : row.rgb) {
        plane.resize(count);
    }
    if (texels.is_grey) {
        scratch.grey.resize(count);
        projection_->project_response(texels.plane[0], scratch.grey);
        for (std::size_t c = 0; c < 3; ++c) {
            scale(scratch.grey, texels.colour[static_cast<int>(c)], row.rgb[c]);
        }
    } else {
        for (std::size_t c = 0; c < 3; ++c) {
            projection_->project_response(texels.plane[c], row.rgb[c]);
        }
    }
    row.direct_white = white_response(row);
    add_indirect(traced, pool, row, scratch);
    row.white = white_response(row);
}

// Response to a constant environment.
Imath::V3f RowBaker::white_response(const CoefficientRow& row) const {
    Imath::V3f white{0, 0, 0};
    for (int c = 0; c < 3; ++c) {
        for (const auto& [coefficient, value] : constant_light_) {
            white[c] += row.rgb[static_cast<std::size_t>(c)][coefficient] * value;
        }
    }
    return white;
}

void RowBaker::add_indirect(const TracedReceiver& traced,
                            const PathPool* pool,
                            CoefficientRow& row,
                            Scratch& scratch) const {
    for (std::uint32_t i = 0; i < traced.paths.size(); ++i) {
        scratch.escapes.reset(projection_->basis().face_resolution());
        if (pool != nullptr) {
            pool->gather(traced.receiver.index, i, scratch.escapes);
        } else {
            scratch.escapes.add(traced.paths[i], 1);
        }
        scratch.coefficients.clear();
        escapes_->project(scratch.escapes, scratch.coefficients);
        const ReceiverSurface& surface = traced.receiver.surfaces[i];
        const Imath::V3f factor = reflectance(surface.point.bsdf) * surface.share;
        for (const Coefficient& coefficient : scratch.coefficients) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto colour = static_cast<int>(c);
                row.rgb[c][coefficient.index] += factor[colour] * coefficient.value[colour];
            }
        }
    }
}

}  // namespace relume::bake
