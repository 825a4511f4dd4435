// The specular part of an edited material at one of its points, where textures and colours of
// vertices make it another than the material's factors alone.
#pragma once

#include "precompute/bake/curves/edited_material.h"
#include "precompute/scene/bsdf.h"
#include "protocol/sampling/curve_sampler.h"

#include <Imath/ImathVec.h>

#include <optional>
#include <string>

namespace relume::bake {

// One curve stands for all of a material, and is what people edit. All that it is multiplied
// with is the point's own:
//
// - GGX, `distribution` edited: F0 and F90 of the point; its roughness is the material's, in
//   masking too.
// - GGX, `fresnel` edited: the point's roughness. F0 of the point over that of the material
//   scales the curve, at all angles alike.
// - Phong, `lobe` edited: ks of the point over that of the material scales the curve; its
//   exponent is the material's.
//
// Where the material's is zero nothing is scaled. A BRDF that was stated or measured in place
// of the scene's has no textures. Keeps a reference to the material. const members are
// thread-safe.
class PointBrdf {
  public:
    PointBrdf(const EditedMaterial& material, const scene::Bsdf& at_point);

    // Valid as long as this and the material.
    [[nodiscard]] sampling::CurveOfBrdf edited() const {
        return {.brdf = own_ ? *own_ : material_.brdf, .curve = material_.curve, .tint = tint_};
    }

  private:
    const EditedMaterial& material_;
    std::optional<curve::CurveBrdf> own_{};  // none: the material's
    Imath::V3f tint_{1, 1, 1};
};

// Of the textures of a material whose BRDF is the scene's: which part of it is left out of the
// curve, "roughness" or "exponent", because one curve stands for all of it; empty: none.
[[nodiscard]] std::string left_out_by_curve(const scene::Material& material,
                                            const EditedMaterial& edited);

}  // namespace relume::bake
