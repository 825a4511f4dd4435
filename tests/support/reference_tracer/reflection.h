// The three reflection models, written from the papers in double precision. World directions,
// unit, away from the surface.
#pragma once

#include "tests/support/reference_tracer/random.h"

#include <Imath/ImathVec.h>

namespace relume::reference {

struct Reflection {
    enum class Model { lambert, phong, ggx };

    Model model = Model::lambert;
    Imath::V3d diffuse{0, 0, 0};
    Imath::V3d specular{0, 0, 0};  // Phong ks; GGX F0
    double exponent = 0;           // Phong
    double alpha = 1;              // GGX
    double grazing = 1;            // GGX F90
    double coat_f0 = 0.04;         // GGX: the dielectric over the diffuse layer,
    double coat_f90 = 1;           // straight on and at grazing angles
    Imath::V3d normal{0, 0, 1};    // shading normal, on the viewer's side

    // f in 1/sr, without the cosine; zero when either direction is below the normal's horizon.
    [[nodiscard]] Imath::V3d value(const Imath::V3d& wi, const Imath::V3d& wo) const;
    // A direction with density `density`. May lie below the horizon.
    [[nodiscard]] Imath::V3d sampled(const Imath::V3d& wo, Random& random) const;
    [[nodiscard]] double density(const Imath::V3d& wi, const Imath::V3d& wo) const;

  private:
    [[nodiscard]] double diffuse_share() const;
};

}  // namespace relume::reference
