// How a surface answers to natural light, as refinement asks.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/vertex/surface_probe.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/reflection.h"
#include "precompute/bake/rows/visibility.h"
#include "protocol/basis/cubemap_projection.h"
#include "protocol/brdf/factored_brdf.h"

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::bake {

// Rows are those of the terms of the point's material, direct light alone, in the Haar basis of
// a cubemap that may be coarser than the light: differences of bright and dark are seen long
// before those of single texels. The light is natural (light_model.h), and the mean radiance of
// each face strays by kFaceDeviation of it, as that of the sky and of the ground do. Lamps and
// a sun add noise that is alike in all coefficients and has kLampVariance times the variance of
// the rest: photographed lights with lamps in them show sharp highlights and the edges of
// shadows far brighter than natural light on average does. The mean
// square of a term is then the square of what the constant light makes, plus the squares of all
// coefficients times their deviations. Terms are scaled so that their squares add up to that of
// the image (factored_brdf.h), and so a bright material weighs more than a dark one.
//
// The coefficients of all terms are added up into a few numbers with random signs [Charikar02].
// Squared lengths of rows and of their differences are kept within an eighth, as a rule.
class LightProbe final : public SurfaceProbe {
  public:
    static constexpr std::size_t kNumbers = 128;
    static constexpr float kFaceDeviation = 0.5F;
    static constexpr float kLampVariance = 40;
    struct Options {
        std::uint32_t face_resolution = 16;  // of the cubemap, as in basis/cubemap.h
        std::uint32_t edge_samples = 4;      // further rays for a texel at a shadow's edge
    };

    // `brdfs` are those of the scene's materials, [materials]; a material without a vertex may
    // have null. Keeps references to all.
    LightProbe(const RayCaster& caster,
               std::span<const brdf::FactoredBrdf* const> brdfs,
               const Options& options);

    [[nodiscard]] std::size_t row_size() const override { return kNumbers; }
    std::uint64_t write_row(const ProbePoint& point, std::span<float> row) const override;

  private:
    struct Scratch {
        Reflection reflection;
        Visibility::Scratch visibility;
        std::vector<float> open;                  // by place
        std::vector<float> irradiance;            // by texel, as are those below
        std::array<std::vector<float>, 3> local;  // directions in the point's frame
        std::vector<float> terms;                 // [texels][terms]
        std::vector<float> weighted;
        std::vector<float> coefficients;
    };

    // How much light of each texel arrives; returns the rays cast.
    std::uint64_t receive(const ProbePoint& point, Scratch& scratch) const;
    void add_term(std::uint32_t term, Scratch& scratch, std::span<float> row) const;

    LightTexels texels_;
    Visibility visibility_;
    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::vector<const brdf::FactoredBrdf*> brdfs_;
    std::array<std::vector<float>, 3> texel_direction_;
    std::vector<basis::CubemapBasis::Term> constant_light_;
    std::vector<float> deviations_;
    mutable tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace relume::bake
