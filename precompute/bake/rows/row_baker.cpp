#include "precompute/bake/rows/row_baker.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/brdf/local_frame.h"

#include <algorithm>
#include <numbers>

namespace relume::bake {
namespace {

constexpr float kJustAboveHorizon = 1e-4F;  // as a cosine

RELUME_CPU_CLONES void scale(std::span<const float> source,
                             float factor,
                             std::span<float> target) {
    for (std::size_t i = 0; i < source.size(); ++i) {
        target[i] = factor * source[i];
    }
}

RELUME_CPU_CLONES void multiply_strided(std::span<const float> values,
                                        const float* factors,
                                        std::size_t stride,
                                        std::span<float> products) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        products[i] = values[i] * std::numbers::pi_v<float> * factors[i * stride];
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
      direct_(caster, texels, parameters.edge_samples) {
    const std::array<std::span<const float>, 3> by_place{
        texels.direction_x(), texels.direction_y(), texels.direction_z()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        texel_direction_[axis].resize(texels.size());
        texels.scatter(by_place[axis], texel_direction_[axis]);
    }
}

void RowBaker::bake(const TracedReceiver& traced,
                    const PathPool* pool,
                    std::vector<CoefficientRow>& rows,
                    Scratch& scratch) const {
    rows.resize(traced.receiver.terms());
    const std::vector<ReceiverSurface>& surfaces = traced.receiver.surfaces;
    if (surfaces.size() != 1 || surfaces[0].brdf == nullptr) {
        bake_reflected(traced, pool, rows.front(), scratch);
        return;
    }
    direct_.compute(traced.receiver, seed_, scratch.texels, scratch.direct);
    project_terms(surfaces[0], rows, scratch);
    add_indirect(traced, pool, rows, scratch);
    const Imath::V3f& colour = surfaces[0].colour;
    for (CoefficientRow& row : rows) {
        for (int c = 0; c < 3 && colour != Imath::V3f(1); ++c) {
            std::vector<float>& plane = row.rgb[static_cast<std::size_t>(c)];
            scale(plane, colour[c], plane);
        }
        row.direct_white = colour;
        row.white = colour;
    }
}

void RowBaker::bake_reflected(const TracedReceiver& traced,
                              const PathPool* pool,
                              CoefficientRow& row,
                              Scratch& scratch) const {
    direct_.compute(traced.receiver, seed_, scratch.texels, scratch.direct);
    project(scratch.texels, row, scratch);
    row.direct_white = white_response(row);
    add_indirect(traced, pool, {&row, 1}, scratch);
    row.white = white_response(row);
}

void RowBaker::project(const TexelRow& texels, CoefficientRow& row, Scratch& scratch) const {
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
}

// The texels hold the irradiance of the vertex over π; a term weighs it by π·g_k.
void RowBaker::project_terms(const ReceiverSurface& surface,
                             std::span<CoefficientRow> rows,
                             Scratch& scratch) const {
    const std::vector<float>& irradiance = scratch.texels.plane[0];
    const brdf::Frame frame = brdf::local_frame(surface.point.shading.normal);
    const std::size_t terms = rows.size();
    std::array<std::vector<float>, 3>& local = scratch.local;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        local[axis].resize(irradiance.size());
    }
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Imath::V3f direction = frame.local_from_world(
            {texel_direction_[0][i], texel_direction_[1][i], texel_direction_[2][i]});
        local[0][i] = direction.x;
        local[1][i] = direction.y;
        // A texel that the horizon cuts has its middle below it.
        local[2][i] = std::max(direction.z, kJustAboveHorizon);
    }
    scratch.terms.resize(irradiance.size() * terms);
    surface.brdf->g.evaluate({local[0], local[1], local[2]}, scratch.terms);
    scratch.weighted.resize(irradiance.size());
    for (std::size_t k = 0; k < terms; ++k) {
        multiply_strided(irradiance, &scratch.terms[k], terms, scratch.weighted);
        CoefficientRow& row = rows[k];
        for (auto& plane : row.rgb) {
            plane.resize(projection_->basis().coefficient_count());
        }
        projection_->project_response(scratch.weighted, row.rgb[0]);
        row.rgb[1] = row.rgb[0];
        row.rgb[2] = row.rgb[0];
    }
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
                            std::span<CoefficientRow> rows,
                            Scratch& scratch) const {
    for (std::uint32_t i = 0; i < traced.paths.size(); ++i) {
        const ReceiverSurface& surface = traced.receiver.surfaces[i];
        scratch.escapes.resize(std::max(scratch.escapes.size(), rows.size()));
        const std::span<EscapeSum> sums = std::span(scratch.escapes).first(rows.size());
        for (EscapeSum& sum : sums) {
            sum.reset(projection_->basis().face_resolution());
        }
        if (pool != nullptr) {
            pool->gather(traced.receiver.index, i, sums);
        } else {
            add_paths(surface, traced.paths[i], 1, sums);
        }
        const Imath::V3f factor = reflectance(surface.point.bsdf) * surface.share;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            scratch.coefficients.clear();
            escapes_->project(sums[k], scratch.coefficients);
            for (const Coefficient& coefficient : scratch.coefficients) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto colour = static_cast<int>(c);
                    rows[k].rgb[c][coefficient.index] +=
                        factor[colour] * coefficient.value[colour];
                }
            }
        }
    }
}

}  // namespace relume::bake
