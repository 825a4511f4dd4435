#include "protocol/basis/cubemap_projection.h"

#include "protocol/basis/haar.h"
#include "protocol/basis/sh_projection.h"

#include <algorithm>

namespace relume::basis {
namespace {

class HaarProjection final : public CubemapProjection {
  public:
    explicit HaarProjection(const CubemapBasis& basis) : CubemapProjection(basis) {}

    void project_radiance(std::span<const float> texels,
                          std::span<float> coefficients) const override {
        std::copy(texels.begin(), texels.end(), coefficients.begin());
        haar_forward_cubemap(basis().face_resolution(), coefficients);
    }
    void project_response(std::span<const float> texels,
                          std::span<float> coefficients) const override {
        project_radiance(texels, coefficients);
    }
    void reconstruct_radiance(std::span<const float> coefficients,
                              std::span<float> texels) const override {
        std::copy(coefficients.begin(), coefficients.end(), texels.begin());
        haar_inverse_cubemap(basis().face_resolution(), texels);
    }
};

}  // namespace

std::shared_ptr<const CubemapProjection> CubemapProjection::onto(const CubemapBasis& basis) {
    if (basis.kind() == CubemapBasis::Kind::haar) {
        return std::make_shared<const HaarProjection>(basis);
    }
    return std::make_shared<const ShProjection>(basis);
}

}  // namespace relume::basis
