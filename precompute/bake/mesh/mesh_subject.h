// The bake of a scene's surface: its receivers are vertices, seen by cameras that move.
#pragma once

#include "precompute/bake/bake_subject.h"
#include "precompute/bake/base/field_request.h"
#include "precompute/bake/base/parameters.h"
#include "precompute/bake/fields/vertex_fields.h"
#include "precompute/bake/mesh/mesh_materials.h"
#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/bake/receivers/vertex/vertex_receivers.h"
#include "precompute/scene/camera.h"

#include <optional>

namespace relume::bake {

class MeshSubject final : public BakeSubject {
  public:
    // Factors the materials and refines the surface, which takes a part of the bake's time.
    // Materials of the caster's scene that are measured have their albedo in it
    // (base/measured_brdf.h). Keeps a reference to the caster. `should_stop` is asked between
    // rounds. Throws BakeError, BakeInterrupted, factors::FactorError, scene::SceneError.
    MeshSubject(const RayCaster& caster,
                const BakeParameters& parameters,
                std::span<const MeasuredBrdf> measured,
                const std::function<bool()>& should_stop,
                const FieldRequest& fields = {});

    [[nodiscard]] const Receivers& receivers() const override { return vertices_; }
    // A vertex lies where it lies.
    [[nodiscard]] std::unique_ptr<RowSource> rows() const override;
    [[nodiscard]] transport::SamplingError sampling_error(
        std::span<const ClusterSample> samples) const override;
    // A surface that can be refined has vertices.
    void check() const override {}
    void describe(transport::Manifest& manifest) const override;
    // After bake_fields().
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
    std::uint64_t measured_hash_ = 0;
    scene::Camera camera_;
    MeshMaterials materials_;
    RefinedSurface surface_;
    VertexReceivers vertices_;
    std::optional<VertexFields> fields_;  // none: nobody asks for what vertices see
};

}  // namespace relume::bake
