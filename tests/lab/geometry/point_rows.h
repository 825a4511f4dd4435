// Rows of single points of a scene, and what they make of some lights.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/relight.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/scene/surface_point.h"
#include "protocol/brdf/factored_brdf.h"

#include <Imath/ImathVec.h>
#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

// Thread-safe. A point's number chooses its samples: under one number `terms` and `reflected`
// see the light's texels by the same rays.
class PointRows {
  public:
    // Keeps a reference to the caster.
    PointRows(const bake::RayCaster& caster,
              const bake::BakeParameters& parameters,
              std::span<const bake::CubemapLight> lights);

    // What the light of each g_k's direction adds up to at the point, as at a vertex:
    // [lights][terms]. `footprint` is what the point stands for, in world units.
    [[nodiscard]] std::vector<std::vector<Imath::V3d>> terms(const scene::SurfacePoint& point,
                                                             const brdf::FactoredBrdf& brdf,
                                                             float footprint,
                                                             std::uint32_t number) const;
    // Radiance towards the point's viewer by the point's own BSDF: [lights].
    [[nodiscard]] std::vector<Imath::V3d> reflected(const scene::SurfacePoint& point,
                                                    float footprint,
                                                    std::uint32_t number) const;

  private:
    struct Scratch {
        bake::RowBaker::Scratch baking;
        std::vector<bake::CoefficientRow> rows;
    };
    [[nodiscard]] std::vector<std::vector<Imath::V3d>> lit(bake::ReceiverSurface surface,
                                                           std::uint32_t number) const;

    bake::LightTexels texels_;
    bake::PathTracer tracer_;
    bake::RowBaker rows_;
    std::vector<std::array<std::vector<float>, 3>> coefficients_;  // of each light
    mutable tbb::enumerable_thread_specific<Scratch> scratches_;
};

// Σ over lobes and terms: what these terms, the first of the BRDF's, send towards the viewer.
// `colours` are of the lobes, `to_viewer` is in the world.
[[nodiscard]] Imath::V3d towards_viewer(const brdf::FactoredBrdf& brdf,
                                        std::span<const Imath::V3f> colours,
                                        const Imath::V3f& normal,
                                        const Imath::V3f& to_viewer,
                                        std::span<const Imath::V3d> terms);

}  // namespace relume::lab
