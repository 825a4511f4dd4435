#include "tests/lab/curves/measured_curves.h"

#include "precompute/factors/merl_brdf.h"
#include "tests/support/merl_file.h"
#include "tests/support/published_fits.h"

#include <string>

namespace relume::lab {

std::vector<MeasuredCurves> measured_curves() {
    std::vector<MeasuredCurves> found;
    for (const test::PublishedFit& fit : test::published_fits()) {
        const factors::MerlBrdf measured(
            std::string(fit.name),
            test::merl_file([&](const Imath::V3f& wi, const Imath::V3f& wo) {
                return fit.evaluate(wi, wo);
            }));
        for (const auto method :
             {factors::CurveMethod::homomorphic, factors::CurveMethod::nonnegative}) {
            found.push_back({.material = fit.name,
                             .method = method,
                             .errors = factors::factorise_curves(measured, method).errors});
        }
    }
    return found;
}

}  // namespace relume::lab
