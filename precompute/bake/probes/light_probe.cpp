#include "precompute/bake/probes/light_probe.h"

#include "precompute/bake/blocks/light_model.h"
#include "precompute/scene/surface_point.h"
#include "protocol/transport/hash.h"

#include <algorithm>

namespace relume::bake {
namespace {

// Nothing in refinement is random: all points look in the same directions, so that surfaces
// that see the same have the same rows.
constexpr std::uint64_t kSeed = 0;
const JitterShift kNoShift{};

}  // namespace

LightProbe::LightProbe(const RayCaster& caster, const Options& options)
    : texels_(options.face_resolution, kSeed),
      visibility_(caster, texels_, options.edge_samples),
      projection_(
          basis::CubemapProjection::onto(basis::CubemapBasis::haar(options.face_resolution))) {
    const std::vector<float> deviations = natural_deviations(projection_->basis());
    for (std::size_t j = 0; j < deviations.size(); ++j) {
        const std::uint64_t bits = transport::mix_bits(j);
        const auto number = static_cast<std::uint32_t>(1 + (bits >> 1U) % (kNumbers - 1));
        sketch_.push_back({number, (bits & 1U) != 0 ? deviations[j] : -deviations[j]});
    }
    // Where the deviation is zero the constant light has a value.
    for (const auto& [index, value] : projection_->basis().constant_light()) {
        sketch_[index] = {0, value};
    }
}

std::uint64_t LightProbe::write_row(const ProbePoint& point, std::span<float> row) const {
    Scratch& scratch = scratch_.local();
    scene::SurfacePoint white;
    white.position = point.position;
    // Facets below the interpolated horizon stand in the way of their own rays.
    white.geometric_normal = point.normal;
    white.shading = scene::Frame::from_normal(point.normal);
    white.bsdf = scene::Bsdf::lambert({1, 1, 1});
    reflect_light(texels_, white, scratch.reflection);

    scratch.open.resize(texels_.size());
    const std::uint64_t before = scratch.visibility.rays;
    visibility_.compute(point.origins, 1, kNoShift, scratch.reflection.grey, scratch.open,
                        scratch.visibility);
    for (std::size_t i = 0; i < scratch.open.size(); ++i) {
        scratch.open[i] *= scratch.reflection.grey[i];
    }
    scratch.texels.resize(texels_.size());
    scratch.coefficients.resize(projection_->basis().coefficient_count());
    texels_.scatter(scratch.open, scratch.texels);
    projection_->project_response(scratch.texels, scratch.coefficients);
    std::fill(row.begin(), row.end(), 0.0F);
    for (std::size_t j = 0; j < sketch_.size(); ++j) {
        row[sketch_[j].number] += sketch_[j].factor * scratch.coefficients[j];
    }
    return scratch.visibility.rays - before;
}

}  // namespace relume::bake
