#include "precompute/bake/rows/escape_projection.h"

#include <array>

namespace relume::bake {
namespace {

class ShrunkEscapes final : public EscapeProjection {
  public:
    explicit ShrunkEscapes(float standard_errors) : standard_errors_(standard_errors) {}

    void project(EscapeSum& escapes, std::vector<Coefficient>& coefficients) const override {
        project_with_shrinkage(escapes, standard_errors_, coefficients);
    }

  private:
    float standard_errors_;
};

class BinnedEscapes final : public EscapeProjection {
  public:
    explicit BinnedEscapes(std::shared_ptr<const basis::CubemapProjection> projection)
        : projection_(std::move(projection)) {}

    void project(EscapeSum& escapes, std::vector<Coefficient>& coefficients) const override {
        const std::uint32_t n = projection_->basis().face_resolution();
        const std::size_t count = projection_->basis().coefficient_count();
        thread_local std::vector<float> texels;
        thread_local std::vector<float> row;
        row.resize(count);
        const std::size_t first = coefficients.size();
        coefficients.resize(first + count);
        for (int c = 0; c < 3; ++c) {
            texels.resize(basis::texel_count(n));
            for (std::uint32_t key = 0; key < texels.size(); ++key) {
                texels[texel_index_from_key(n, key)] = escapes.nodes()[key].sum[c];
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
    const basis::CubemapBasis& basis = projection->basis();
    if (basis.kind() == basis::CubemapBasis::Kind::haar) {
        return std::make_unique<ShrunkEscapes>(standard_errors);
    }
    return std::make_unique<BinnedEscapes>(std::move(projection));
}

}  // namespace relume::bake
