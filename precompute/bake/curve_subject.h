// The image of the scene's camera as it answers to curves of materials, under a light that is
// frozen in it.
#pragma once

#include "precompute/bake/bake_subject.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/curves/frozen_light.h"
#include "precompute/bake/image_subject.h"
#include "precompute/bake/shown_materials.h"

#include <vector>

namespace relume::bake {

class CurveSubject final : public BakeSubject {
  public:
    // Keeps references to the caster, the light and the materials.
    CurveSubject(const RayCaster& caster,
                 const BakeParameters& parameters,
                 const FrozenLight& light,
                 const std::vector<EditedMaterial>& materials);

    [[nodiscard]] const Receivers& receivers() const override { return image_.receivers(); }
    [[nodiscard]] std::unique_ptr<RowSource> rows() const override;
    // Noise alone: what the estimator of curves makes has no bias.
    [[nodiscard]] transport::SamplingError sampling_error(
        std::span<const ClusterSample> samples) const override;
    void check() const override { image_.check(); }
    void describe(transport::Manifest& manifest) const override;
    // Edited materials that no pixel sees, and what factoring measured ones cost. After
    // coverage().
    [[nodiscard]] nlohmann::json measured() const override;
    // All of every pixel: the light past the scene is part of the image.
    [[nodiscard]] std::vector<float> coverage() override;
    void write_tables(transport::TransportWriter& /*writer*/) override {}
    // Those of an image, and view/materials.png. After coverage().
    void write_files(const std::filesystem::path& directory) const override;

  private:
    const RayCaster& caster_;
    BakeParameters parameters_;
    const FrozenLight& light_;
    const std::vector<EditedMaterial>& materials_;
    ImageSubject image_;
    ShownMaterials shown_;
};

}  // namespace relume::bake
