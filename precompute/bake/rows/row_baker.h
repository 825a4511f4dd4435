// One receiver's transport, as coefficients of the light in red, green and blue.
#pragma once

#include "precompute/bake/rows/direct_light.h"
#include "precompute/bake/rows/escape_projection.h"
#include "precompute/bake/rows/path_pool.h"
#include "protocol/basis/cubemap_projection.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::bake {

// The white responses give a receiver its tint. A term of a vertex takes the vertex's own
// colour for it: g_k may be negative, so that the response to white light says nothing of how
// colourful others are.
struct CoefficientRow {
    std::array<std::vector<float>, 3> rgb;  // N values each
    Imath::V3f direct_white{0, 0, 0};       // response to a white light, direct part
    Imath::V3f white{0, 0, 0};              // all of it
};

class RowBaker {
  public:
    RowBaker(const RayCaster& caster,
             const LightTexels& texels,
             const BakeParameters& parameters);

    [[nodiscard]] const basis::CubemapProjection& projection() const { return *projection_; }

    // One per thread.
    struct Scratch {
        DirectLight::Scratch direct;
        TexelRow texels;
        std::vector<float> grey;                  // coefficients of a row without colour
        std::array<std::vector<float>, 3> local;  // directions of texels, x, y, z
        std::vector<float> terms;                 // g of every texel, [texels][terms]
        std::vector<float> weighted;
        std::vector<EscapeSum> escapes;
        std::vector<Coefficient> coefficients;
    };

    // Makes the receiver's rows, as many as it has terms. `pool` may be null: then the
    // receiver's own paths are all there is.
    void bake(const TracedReceiver& traced,
              const PathPool* pool,
              std::vector<CoefficientRow>& rows,
              Scratch& scratch) const;

  private:
    // Of a receiver whose surfaces reflect to one viewer.
    void bake_reflected(const TracedReceiver& traced,
                        const PathPool* pool,
                        CoefficientRow& row,
                        Scratch& scratch) const;
    void project(const TexelRow& texels, CoefficientRow& row, Scratch& scratch) const;
    void project_terms(const ReceiverSurface& surface,
                       std::span<CoefficientRow> rows,
                       Scratch& scratch) const;
    void add_indirect(const TracedReceiver& traced,
                      const PathPool* pool,
                      std::span<CoefficientRow> rows,
                      Scratch& scratch) const;

    [[nodiscard]] Imath::V3f white_response(const CoefficientRow& row) const;

    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::unique_ptr<const EscapeProjection> escapes_;
    std::vector<basis::CubemapBasis::Term> constant_light_;
    std::uint64_t seed_;
    DirectLight direct_;
    std::array<std::vector<float>, 3> texel_direction_;  // x, y, z of every texel, row-major
};

}  // namespace relume::bake
