// Pairs of directions at which an isotropic BRDF is looked at when curves are fitted to it, and
// when the fit is judged: spread evenly over u of the half angle, the difference angle and the
// azimuth of the difference, so that every sample of every curve is met, and a highlight as
// well as all that surrounds it. Deterministic.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "protocol/curve/curve.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::factors {

struct CurveFitSample {
    Imath::V3f wi{0, 0, 1};
    Imath::V3f wo{0, 0, 1};
    // Where its angles lie: half, difference, incidence, viewing.
    std::array<curve::CurvePlace, 4> places;
    double cosines = 0;      // cos θi cos θo
    double spread = 0;       // sin 2θd, the part of the differences that it stands for
    double solid_angle = 0;  // its part of cos θi dωi cos θo dωo, up to one factor for all
    Imath::V3d value{0, 0, 0};  // ρ, rgb with the lobes' mean colours; not negative
};

struct CurveFitSamples {
    std::vector<CurveFitSample> samples;
    Imath::V3d mean{0, 0, 0};  // of ρ, weighted by the solid angle
    // Values, of any colour, that were negative and count as 0.
    std::size_t negative_count = 0;

    // Differences below this part of the mean cannot be seen: logarithms are those of values
    // with it added.
    static constexpr double kFloor = 1e-4;
    [[nodiscard]] Imath::V3d floor() const { return mean * kFloor; }

    // Of the values of one colour by the solid angle that they stand for, the one that has
    // `part` of the solid angle below it.
    [[nodiscard]] double quantile(int colour, double part) const;
};

// `shift` in [0, 1) moves all samples: other shifts, other directions. Throws FactorError for a
// BRDF that is black in all colours or has a value that is not finite. Uses all cores.
[[nodiscard]] CurveFitSamples curve_fit_samples(const BrdfLobes& lobes,
                                                std::size_t count,
                                                double shift);

}  // namespace relume::factors
