// Rows that answer to curves: what nobody edits, and for each edited material its diffuse
// colour and the Daubechies-4 coefficients of its curve (basis/curve_basis.h).
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/row_source.h"
#include "precompute/bake/curves/curve_estimator.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/curves/frozen_light.h"
#include "precompute/bake/curves/unedited_receivers.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace relume::bake {

class CurveRows final : public RowSource {
  public:
    // Keeps references to all but the parameters.
    CurveRows(const RayCaster& caster,
              const PixelReceivers& pixels,
              const FrozenLight& light,
              const std::vector<EditedMaterial>& materials,
              const BakeParameters& parameters);

    [[nodiscard]] const Receivers& receivers() const override { return pixels_; }
    [[nodiscard]] const SignalModel& signals() const override { return signals_; }
    std::uint64_t move_to(std::uint32_t first_cluster, std::uint32_t cluster_count) override;
    // Every pixel sees something: the scene, or the environment past it.
    bool bake(std::size_t receiver,
              std::vector<CoefficientRow>& rows,
              std::uint64_t& rays) const override;
    bool bake_alone(std::size_t receiver, std::vector<CoefficientRow>& rows) const override;

  private:
    struct Scratch {
        std::vector<CoefficientRow> light;
        CurveShares shares;
    };

    // All but the unedited surfaces.
    void bake_edited(std::size_t receiver, CoefficientRow& row, std::uint64_t& rays) const;
    void add_background(const Receiver& seen, Imath::V3f& rest) const;
    // A row of light times the light.
    void add_unedited(const CoefficientRow& light, CoefficientRow& row) const;

    const PixelReceivers& pixels_;
    const std::vector<EditedMaterial>& materials_;
    std::vector<std::optional<std::uint32_t>> curve_of_material_;  // of the scene's
    light::Background background_;
    sampling::TexelLight texel_light_;
    FrozenRadiance radiance_;
    CurveEstimator estimator_;
    UneditedReceivers unedited_;
    // None where all materials of the scene are edited.
    std::unique_ptr<LightRows> light_rows_;
    std::array<std::vector<float>, 3> light_;  // its coefficients, red, green and blue
    SignalModel signals_;
    mutable tbb::enumerable_thread_specific<Scratch> scratches_;
};

}  // namespace relume::bake
