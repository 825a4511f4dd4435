#include "precompute/bake/probes/light_probe.h"

#include "precompute/bake/blocks/light_model.h"
#include "precompute/scene/surface_point.h"
#include "protocol/basis/cpu_clones.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace relume::bake {
namespace {

// Nothing in refinement is random: all points look in the same directions, so that surfaces
// that see the same have the same rows.
constexpr std::uint64_t kSeed = 0;
const JitterShift kNoShift{};

// Of a row, the numbers that hold what the constant light makes, one for each term.
constexpr std::size_t kConstants = brdf::FactoredBrdf::kMostTerms;

// How far coefficients stray under natural light with lamps.
std::vector<float> deviations_with_lamps(const basis::CubemapBasis& basis) {
    std::vector<float> deviations = natural_deviations(basis);
    for (const auto& [index, value] : basis.constant_light()) {
        deviations[index] = LightProbe::kFaceDeviation * value;
    }
    const double natural =
        std::inner_product(deviations.begin(), deviations.end(), deviations.begin(), 0.0);
    const double lamps =
        LightProbe::kLampVariance * natural / static_cast<double>(deviations.size());
    for (float& deviation : deviations) {
        deviation = static_cast<float>(std::sqrt(double{deviation} * deviation + lamps));
    }
    return deviations;
}

// A texel that the horizon cuts has its middle below it.
constexpr float kJustAboveHorizon = 1e-4F;

RELUME_CPU_CLONES void turn(const brdf::Frame& frame,
                            const std::array<std::vector<float>, 3>& world,
                            std::array<std::vector<float>, 3>& local) {
    const std::size_t count = world[0].size();
    const float* x = world[0].data();
    const float* y = world[1].data();
    const float* z = world[2].data();
    for (std::size_t i = 0; i < count; ++i) {
        const Imath::V3f direction = frame.local_from_world({x[i], y[i], z[i]});
        local[0][i] = direction.x;
        local[1][i] = direction.y;
        local[2][i] = std::max(direction.z, kJustAboveHorizon);
    }
}

}  // namespace

LightProbe::LightProbe(const RayCaster& caster,
                       std::span<const brdf::FactoredBrdf* const> brdfs,
                       const Options& options)
    : texels_(options.face_resolution, kSeed),
      visibility_(caster, texels_, options.edge_samples),
      projection_(
          basis::CubemapProjection::onto(basis::CubemapBasis::haar(options.face_resolution))),
      brdfs_(brdfs.begin(), brdfs.end()),
      constant_light_(projection_->basis().constant_light()),
      deviations_(deviations_with_lamps(projection_->basis())) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        texel_direction_[axis].resize(texels_.size());
    }
    texels_.scatter(texels_.direction_x(), texel_direction_[0]);
    texels_.scatter(texels_.direction_y(), texel_direction_[1]);
    texels_.scatter(texels_.direction_z(), texel_direction_[2]);
}

std::uint64_t LightProbe::receive(const ProbePoint& point, Scratch& scratch) const {
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
        scratch.open[i] *= std::numbers::pi_v<float> * scratch.reflection.grey[i];
    }
    scratch.irradiance.resize(texels_.size());
    texels_.scatter(scratch.open, scratch.irradiance);
    return scratch.visibility.rays - before;
}

void LightProbe::add_term(std::uint32_t term, Scratch& scratch, std::span<float> row) const {
    scratch.coefficients.resize(deviations_.size());
    projection_->project_response(scratch.weighted, scratch.coefficients);
    for (const auto& [index, value] : constant_light_) {
        row[term] += value * scratch.coefficients[index];
    }
    const std::uint64_t seed = std::uint64_t{term} << 32U;
    for (std::size_t j = 0; j < deviations_.size(); ++j) {
        const std::uint64_t bits = transport::mix_bits(seed + j);
        const std::size_t number = kConstants + (bits >> 1U) % (kNumbers - kConstants);
        const float value = deviations_[j] * scratch.coefficients[j];
        row[number] += (bits & 1U) != 0 ? value : -value;
    }
}

std::uint64_t LightProbe::write_row(const ProbePoint& point, std::span<float> row) const {
    Scratch& scratch = scratch_.local();
    const std::uint64_t rays = receive(point, scratch);
    const brdf::DirectionTable& g = brdfs_[point.material]->g;
    const std::uint32_t terms = g.shape().depth;
    for (auto& plane : scratch.local) {
        plane.resize(texels_.size());
    }
    turn(brdf::local_frame(point.normal), texel_direction_, scratch.local);
    scratch.terms.resize(texels_.size() * terms);
    g.evaluate({scratch.local[0], scratch.local[1], scratch.local[2]}, scratch.terms);
    scratch.weighted.resize(texels_.size());
    std::fill(row.begin(), row.end(), 0.0F);
    for (std::uint32_t term = 0; term < terms; ++term) {
        for (std::size_t i = 0; i < scratch.weighted.size(); ++i) {
            scratch.weighted[i] = scratch.irradiance[i] * scratch.terms[i * terms + term];
        }
        add_term(term, scratch, row);
    }
    return rays;
}

}  // namespace relume::bake
