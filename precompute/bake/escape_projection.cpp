#include "precompute/bake/escape_projection.h"

#include "precompute/bake/path_tracer.h"

#include <array>

namespace relume::bake {
namespace {

class ShrunkEscapes final : public EscapeProjection {
  public:
    ShrunkEscapes(std::uint32_t face_resolution, float standard_errors)
        : face_resolution_(face_resolution), standard_errors_(standard_errors) {}

    void project(std::vector<Contribution>& contributions,
                 std::vector<Coefficient>& coefficients) const override {
        project_with_shrinkage(face_resolution_, contributions, standard_errors_, coefficients);
    }

  private:
    std::uint32_t face_resolution_;
    float standard_errors_;
};

class BinnedEscapes final : public EscapeProjection {
  public:
    explicit BinnedEscapes(std::shared_ptr<const basis::CubemapProjection> projection)
        : projection_(std::move(projection)) {}

    void project(std::vector<Contribution>& contributions,
                 std::vector<Coefficient>& coefficients) const override {
        const std::uint32_t n = projection_->basis().face_resolution();
        const std::size_t count = projection_->basis().coefficient_count();
        thread_local std::vector<float> texels;
        thread_local std::vector<float> row;
        row.resize(count);
        const std::size_t first = coefficients.size();
        coefficients.resize(first + count);
        for (int c = 0; c < 3; ++c) {
            texels.assign(basis::texel_count(n), 0.0F);
            for (const Contribution& one : contributions) {
                texels[texel_index_from_key(n, one.texel)] += one.value[c];
            }
            projection_->project_response(texels, row);
            for (std::uint32_t j = 0; j < count; ++j) {
                coefficients[first + j].index = j;
                coefficients[first + j].value[c] = row[j];
            }
        }
    }

  private:
    std::shared_ptr<const basis::CubemapProjection> projection_;
};

}  // namespace

std::unique_ptr<const EscapeProjection> EscapeProjection::onto(
    std::shared_ptr<const basis::CubemapProjection> projection, float standard_errors) {
    const basis::LightBasis& basis = projection->basis();
    if (basis.kind() == basis::LightBasis::Kind::haar) {
        return std::make_unique<ShrunkEscapes>(basis.face_resolution(), standard_errors);
    }
    return std::make_unique<BinnedEscapes>(std::move(projection));
}

}  // namespace relume::bake
