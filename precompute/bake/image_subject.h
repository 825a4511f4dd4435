// The image that a scene's own camera sees.
#pragma once

#include "precompute/bake/bake_subject.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/view_files.h"

namespace relume::bake {

class ImageSubject final : public BakeSubject {
  public:
    // Keeps a reference to the caster. Throws SceneError.
    ImageSubject(const RayCaster& caster, const BakeParameters& parameters);

    [[nodiscard]] const PixelReceivers& pixels() const { return pixels_; }
    [[nodiscard]] const Receivers& receivers() const override { return pixels_; }
    [[nodiscard]] std::unique_ptr<RowSource> rows() const override;
    [[nodiscard]] transport::SamplingError sampling_error(
        std::span<const ClusterSample> samples) const override;
    void check() const override;
    void describe(transport::Manifest& manifest) const override;
    [[nodiscard]] nlohmann::json measured() const override;
    [[nodiscard]] std::vector<float> coverage() override;
    // A picture has none.
    void write_tables(transport::TransportWriter& /*writer*/) override {}
    void write_files(const std::filesystem::path& directory) const override;

  private:
    const RayCaster& caster_;
    const scene::Scene& scene_;
    BakeParameters parameters_;
    PixelReceivers pixels_;
    ViewImages view_;
};

}  // namespace relume::bake
