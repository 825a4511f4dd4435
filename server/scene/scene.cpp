#include "server/scene/scene.h"

#include "server/scene/beginning.h"
#include "server/view/image_view.h"
#include "server/view/mesh/mesh_view.h"

#include <utility>

namespace relume::served {
namespace {

std::vector<std::uint32_t> materials_of_vertices(const transport::VertexClusters& clusters) {
    std::vector<std::uint32_t> materials;
    materials.reserve(clusters.vertex_count());
    for (const transport::Cluster& cluster : clusters.clusters()) {
        materials.insert(materials.end(), cluster.vertices, cluster.material);
    }
    return materials;
}

}  // namespace

Scene::Scene(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)),
      operator_(std::make_shared<const engine::StoredOperator>(transport_)),
      workspace_(std::make_shared<const engine::Workspace>(operator_)) {
    const transport::Manifest& manifest = transport_->manifest();
    if (manifest.signal_basis.is_of_light()) {
        projection_ = basis::CubemapProjection::onto(manifest.signal_basis.cubemap());
    }
    if (manifest.materials) {
        editable_points_ = std::make_shared<const materials::EditablePoints>(transport_);
    }
    if (!transport_->surface()) {
        beginning_ = beginning_of_image(manifest);
        return;
    }
    const transport::Surface& surface = *transport_->surface();
    surface_ = std::make_shared<const view::DrawnSurface>(
        std::shared_ptr<const transport::Surface>(transport_, &surface),
        manifest.mesh->materials, manifest.layout.clusters());
    if (transport_->visibility()) {
        lit_surface_ = std::make_shared<const triple::LitSurface>(
            surface.mesh, materials_of_vertices(manifest.layout.clusters()),
            *transport_->visibility());
        parts_ = parts_of(manifest.mesh->materials);
    }
    bounds_ = bounds_of(surface.mesh, manifest.mesh->frame);
    beginning_ = beginning_of_mesh(manifest, surface.mesh, *bounds_);
}

std::span<const transport::CurveRecord> Scene::curves() const {
    if (editable_points_) {
        return editable_points_->records();
    }
    const std::optional<transport::CurvesSection>& section = transport_->manifest().curves;
    return section ? section->curves : std::span<const transport::CurveRecord>();
}

std::unique_ptr<view::View> Scene::make_view(const view::GivenRadiance* given) const {
    if (!surface_) {
        return std::make_unique<view::ImageView>(transport_);
    }
    const transport::Manifest& manifest = transport_->manifest();
    return std::make_unique<view::MeshView>(
        surface_,
        view::VertexRadiance(manifest.layout.clusters(), manifest.block_basis,
                             transport_->tint()),
        manifest.mesh->frame, beginning_, given);
}

void Scene::write_image(std::span<const float> sums, std::span<float> rgb) const {
    view::write_image(*make_view(), sums, rgb);
}

std::uint64_t Scene::bytes() const {
    return operator_->bytes() + (surface_ ? surface_->bytes() : 0) +
           (editable_points_ ? editable_points_->bytes() : 0) +
           (lit_surface_ ? lit_surface_->byte_count() : 0);
}

}  // namespace relume::served
