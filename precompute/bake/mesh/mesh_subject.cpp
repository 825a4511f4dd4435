#include "precompute/bake/mesh/mesh_subject.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/fingerprint.h"
#include "precompute/bake/probes/light_probe.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "precompute/bake/view_files.h"
#include "protocol/transport/hash.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>

namespace relume::bake {
namespace {

MeshMaterials materials_of(const scene::Scene& scene,
                           const BakeParameters& parameters,
                           std::span<const MeasuredBrdf> measured) {
    return mesh_materials(
        scene, measured,
        {.method = parameters.factor_method,
         .light = parameters.factor_method == factors::Method::svd
                      ? factors::LightModel::natural
                      : factors::LightModel::uncorrelated,
         .target_error = parameters.target_error,
         .terms = parameters.terms > 0 ? std::optional(parameters.terms) : std::nullopt});
}

std::vector<const brdf::FactoredBrdf*> brdfs_of(const MeshMaterials& materials) {
    std::vector<const brdf::FactoredBrdf*> brdfs;
    for (const factors::Factorisation& factored : materials.factored) {
        brdfs.push_back(&factored.brdf);
    }
    return brdfs;
}

// 0 where nothing is measured.
std::uint64_t hash_of(std::span<const MeasuredBrdf> measured) {
    std::uint64_t hash = 0;
    for (const MeasuredBrdf& one : measured) {
        for (const char letter : one.material) {
            hash = transport::mix_bits(hash ^ static_cast<unsigned char>(letter));
        }
        hash = transport::mix_bits(hash ^ one.content_hash);
    }
    return hash;
}

RefinedSurface refined(const RayCaster& caster,
                       const MeshMaterials& materials,
                       const BakeParameters& parameters,
                       const std::function<bool()>& should_stop) {
    const std::vector<const brdf::FactoredBrdf*> brdfs = brdfs_of(materials);
    const LightProbe probe(caster, brdfs, {});
    return refine_surface(
        caster.scene(), probe,
        {.most_vertices = parameters.vertices,
         .target_error = parameters.target_error,
         .progress = [&](std::size_t /*vertices*/) {
             if (should_stop && should_stop()) {
                 throw BakeInterrupted("stopped while the surface was refined");
             }
         }});
}

}  // namespace

MeshSubject::MeshSubject(const RayCaster& caster,
                         const BakeParameters& parameters,
                         std::span<const MeasuredBrdf> measured,
                         const std::function<bool()>& should_stop,
                         const FieldRequest& fields)
    : caster_(caster),
      scene_(caster.scene()),
      parameters_(parameters),
      measured_hash_(hash_of(measured)),
      camera_(scene_.camera, parameters.width, parameters.height),
      materials_(materials_of(scene_, parameters, measured)),
      surface_(refined(caster, materials_, parameters, should_stop)),
      vertices_(scene_, surface_, brdfs_of(materials_)) {
    if (!fields.empty()) {
        fields_.emplace(caster, vertices_, fields, parameters);
    }
}

std::unique_ptr<RowSource> MeshSubject::rows() const {
    return std::make_unique<LightRows>(caster_, vertices_, parameters_);
}

// Another seed finds the same vertices.
transport::SamplingError MeshSubject::sampling_error(
    std::span<const ClusterSample> samples) const {
    return measure_sampling_error(caster_, vertices_, vertices_, parameters_, samples);
}

void MeshSubject::describe(transport::Manifest& manifest) const {
    manifest.kind = transport::Kind::mesh;
    manifest.signal_basis = signal_basis(parameters_);
    std::vector<transport::Cluster> clusters;
    for (const VertexCluster& cluster : surface_.clusters) {
        clusters.push_back({.vertices = cluster.count,
                            .terms = materials_.factored[cluster.material].brdf.terms,
                            .material = cluster.material});
    }
    manifest.layout = transport::ReceiverLayout::vertex_clusters(
        transport::VertexClusters(std::move(clusters)));
    manifest.mesh = transport::MeshSection{
        .frame = {.origin = scene_.frame.origin, .unit = scene_.frame.unit},
        .view = {.width = parameters_.width, .height = parameters_.height},
        .materials = materials_.records,
        .mesh = {},
        .brdfs = {},
        .textures = {}};
    manifest.camera = {.eye = camera_.eye(),
                       .right = camera_.right(),
                       .up = camera_.up(),
                       .forward = camera_.forward(),
                       .tan_half_width = camera_.tan_half_width(),
                       .tan_half_height = camera_.tan_half_height()};
    std::string fields;
    if (fields_) {
        manifest.bake.update(fields_->request_json());
        fields = fields_->request_json().dump();
    }
    manifest.fingerprint =
        fingerprint_of(scene_, camera_, parameters_, manifest.generator, fields) ^
        measured_hash_;
}

nlohmann::json MeshSubject::measured() const {
    nlohmann::json brdfs = nlohmann::json::array();
    for (const factors::Factorisation& factored : materials_.factored) {
        brdfs.push_back({{"name", factored.brdf.name},
                         {"terms", factored.brdf.terms},
                         {"error", factored.error},
                         {"meets_target", factored.meets_target},
                         {"tears_pair", factored.tears_pair},
                         {"negative_norm", factored.negative_norm},
                         {"error_of_terms", factored.errors}});
    }
    const RefinementReport& report = surface_.report;
    nlohmann::json measured{{"brdfs", std::move(brdfs)},
                            {"surface",
                             {{"vertices", surface_.vertex_count()},
                              {"triangles", surface_.mesh.triangles.size()},
                              {"start_vertices", report.start_vertices},
                              {"scene_triangles", report.scene_triangles},
                              {"dropped_triangles", report.dropped_triangles},
                              {"two_sided_triangles", report.two_sided_triangles},
                              {"probes", report.probes},
                              {"rays", report.rays},
                              {"interpolation_error", report.interpolation_error},
                              {"meets_target", report.meets_target}}},
                            {"materials", materials_.notes}};
    if (fields_) {
        measured["visibility"] =
            json_from_counts(fields_->counts(), fields_->face_resolution());
    }
    return measured;
}

std::vector<float> MeshSubject::coverage() {
    return std::vector<float>(surface_.vertex_count(), 1.0F);
}

std::optional<std::uint64_t> MeshSubject::field_point_count() const {
    return fields_ ? std::optional(fields_->point_count()) : std::nullopt;
}

void MeshSubject::bake_fields(const FieldWork& work) {
    if (fields_) {
        fields_->bake(work);
    }
}

void MeshSubject::write_tables(transport::TransportWriter& writer) {
    if (fields_) {
        fields_->write(writer);
    }
    writer.write_surface(
        {.mesh = surface_.mesh, .brdfs = materials_.brdfs(), .textures = materials_.textures});
}

void MeshSubject::write_files(const std::filesystem::path& directory) const {
    write_pictures(directory);
}

}  // namespace relume::bake
