// Three materials of the MERL database as a published fit has them, for tests and figures that
// need measured BRDFs where no measured file is at hand: [Low12]'s microfacet model,
//
//     f = (diffuse + F(θ_d)·D(θ_h)·G/(cos θi cos θo))/π,  D = scale/(1 + width·(1 − cos
//     θ_h))^p,
//
// F the reflectance of a dielectric of the index, and G that of V-shaped grooves
// [CookTorrance82]. The parameters are its authors', as [Dupuy15] lists them. The materials are
// a metal, a plastic and a cloth.
#pragma once

#include <Imath/ImathVec.h>

#include <span>
#include <string_view>

namespace relume::test {

struct PublishedFit {
    std::string_view name;  // in the database
    Imath::V3d diffuse;     // by colour, as is scale
    Imath::V3d scale;
    double width = 0;
    double power = 0;
    double index = 0;

    // f in 1/sr of two unit directions above the horizon, z along the normal.
    [[nodiscard]] Imath::V3f evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const;
};

[[nodiscard]] std::span<const PublishedFit> published_fits();

}  // namespace relume::test
