// The image that a scene's own camera sees.
#pragma once

#include "precompute/bake/bake_subject.h"
#include "precompute/bake/base/field_request.h"
#include "precompute/bake/fields/editable_fields.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/shown_materials.h"
#include "precompute/bake/view_files.h"

#include <optional>

namespace relume::bake {

class ImageSubject final : public BakeSubject {
  public:
    // Keeps a reference to the caster. With editable materials all pixels are looked at. Throws
    // SceneError, and what EditableFields throws.
    ImageSubject(const RayCaster& caster,
                 const BakeParameters& parameters,
                 const FieldRequest& fields = {});

    [[nodiscard]] const PixelReceivers& pixels() const { return pixels_; }
    [[nodiscard]] const Receivers& receivers() const override { return pixels_; }
    [[nodiscard]] std::unique_ptr<RowSource> rows() const override;
    [[nodiscard]] transport::SamplingError sampling_error(
        std::span<const ClusterSample> samples) const override;
    void check() const override;
    void describe(transport::Manifest& manifest) const override;
    // After bake_fields() and coverage().
    [[nodiscard]] nlohmann::json measured() const override;
    [[nodiscard]] std::vector<float> coverage() override;
    [[nodiscard]] std::optional<std::uint64_t> field_point_count() const override;
    void bake_fields(const FieldWork& work) override;
    void write_tables(transport::TransportWriter& writer) override;
    void write_files(const std::filesystem::path& directory) const override;

  private:
    const RayCaster& caster_;
    const scene::Scene& scene_;
    BakeParameters parameters_;
    PixelReceivers pixels_;
    std::optional<EditableFields> editable_;  // none: nobody edits its materials
    ViewImages view_;
    ShownMaterials shown_;  // of editable_
};

}  // namespace relume::bake
