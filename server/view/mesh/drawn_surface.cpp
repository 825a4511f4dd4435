#include "server/view/mesh/drawn_surface.h"

#include <algorithm>
#include <utility>

namespace relume::view {

DrawnSurface::DrawnSurface(std::shared_ptr<const transport::Surface> surface,
                           std::span<const transport::MaterialRecord> materials,
                           const transport::VertexClusters& clusters)
    : surface_(std::move(surface)), clusters_(clusters), holes_(surface_, materials) {
    textures_.reserve(surface_->textures.size());  // materials point to them
    for (const transport::SurfaceTexture& texture : surface_->textures) {
        textures_.emplace_back(texture);
    }
    for (const transport::MaterialRecord& record : materials) {
        DrawnMaterial material{.brdf = &surface_->brdfs[record.brdf], .lobes = {}};
        for (const transport::LobeRecord& lobe : record.lobes) {
            material.lobes.push_back(
                {.colour = lobe.colour,
                 .texture = lobe.texture ? &textures_[*lobe.texture] : nullptr});
            material.has_textures = material.has_textures || lobe.texture.has_value();
        }
        materials_.push_back(std::move(material));
    }
    first_terms_.reserve(clusters.vertex_count());
    clusters_of_vertices_.reserve(clusters.vertex_count());
    for (std::uint32_t number = 0; number < clusters.clusters().size(); ++number) {
        const transport::Cluster& cluster = clusters.clusters()[number];
        clusters_of_vertices_.insert(clusters_of_vertices_.end(), cluster.vertices, number);
        for (std::uint32_t i = 0; i < cluster.vertices; ++i) {
            first_terms_.push_back(static_cast<std::uint32_t>(term_count_));
            term_count_ += cluster.terms;
        }
        most_terms_ = std::max(most_terms_, cluster.terms);
    }
}

std::size_t DrawnSurface::bytes() const {
    std::size_t bytes = 2 * first_terms_.size() * sizeof(std::uint32_t);
    for (const MippedTexture& texture : textures_) {
        bytes += texture.bytes();
    }
    return bytes;
}

}  // namespace relume::view
