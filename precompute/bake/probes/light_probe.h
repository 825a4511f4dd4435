// How a white surface answers to natural light, as refinement asks.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/vertex/surface_probe.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/reflection.h"
#include "precompute/bake/rows/visibility.h"
#include "protocol/basis/cubemap_projection.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::bake {

// Lambert's response times visibility, in the Haar basis of a cubemap that is coarser than the
// light, as differences of bright and dark are seen long before those of single texels. Its
// mean square under natural light (light_model.h) is the square of what the constant light
// makes, plus the squares of all coefficients times their deviations. The latter are added up
// into kNumbers − 1 numbers with random signs [Charikar02]; lengths of rows and of their
// differences are kept within a few per cent.
class LightProbe final : public SurfaceProbe {
  public:
    static constexpr std::size_t kNumbers = 128;
    struct Options {
        std::uint32_t face_resolution = 16;  // of the cubemap, as in basis/cubemap.h
        std::uint32_t edge_samples = 4;      // further rays for a texel at a shadow's edge
    };

    // Keeps a reference to the caster.
    LightProbe(const RayCaster& caster, const Options& options);

    [[nodiscard]] std::size_t row_size() const override { return kNumbers; }
    std::uint64_t write_row(const ProbePoint& point, std::span<float> row) const override;

  private:
    struct Scratch {
        Reflection reflection;
        Visibility::Scratch visibility;
        std::vector<float> open;
        std::vector<float> texels;
        std::vector<float> coefficients;
    };
    // Where a coefficient is added, and times what.
    struct SketchEntry {
        std::uint32_t number = 0;
        float factor = 0;
    };

    LightTexels texels_;
    Visibility visibility_;
    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::vector<SketchEntry> sketch_;  // by coefficient
    mutable tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace relume::bake
