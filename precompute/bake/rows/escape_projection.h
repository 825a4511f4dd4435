// From the escapes of a receiver's paths to coefficients of its row, whichever the basis.
#pragma once

#include "precompute/bake/rows/shrinkage.h"
#include "protocol/basis/cubemap_projection.h"

#include <memory>
#include <vector>

namespace relume::bake {

// - Haar: with shrinkage; `standard_errors` as there.
// - Spherical harmonics: as they are. Every escape lights every function, so that the few
//   coefficients are means over all paths, and nothing in them is as local as a spike.
//
// Thread-safe.
class EscapeProjection {
  public:
    [[nodiscard]] static std::unique_ptr<const EscapeProjection> onto(
        std::shared_ptr<const basis::CubemapProjection> projection, float standard_errors);

    virtual ~EscapeProjection() = default;
    EscapeProjection(const EscapeProjection&) = delete;
    EscapeProjection& operator=(const EscapeProjection&) = delete;

    // Appends the coefficients of the sum. Leaves nothing of use in `escapes`.
    virtual void project(EscapeSum& escapes, std::vector<Coefficient>& coefficients) const = 0;

  protected:
    EscapeProjection() = default;
};

}  // namespace relume::bake
