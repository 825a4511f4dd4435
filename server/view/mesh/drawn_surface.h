// The surface of a mesh transport, ready to be drawn. All views of a scene share one.
#pragma once

#include "protocol/brdf/factored_brdf.h"
#include "protocol/transport/mesh_section.h"
#include "protocol/transport/surface.h"
#include "protocol/transport/vertex_clusters.h"
#include "server/view/mesh/holes.h"
#include "server/view/mesh/mipped_texture.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::view {

struct DrawnLobe {
    Imath::V3f colour{0, 0, 0};
    const MippedTexture* texture =
        nullptr;  // the colour is multiplied with it, if there is one
};

struct DrawnMaterial {
    const brdf::FactoredBrdf* brdf = nullptr;
    std::vector<DrawnLobe> lobes;  // as many as the BRDF has
    bool has_textures = false;
};

// Immutable; safe to share between threads.
class DrawnSurface {
  public:
    // All of one transport, and checked as its reader does. Keeps a reference to the clusters,
    // which live as long as the surface.
    DrawnSurface(std::shared_ptr<const transport::Surface> surface,
                 std::span<const transport::MaterialRecord> materials,
                 const transport::VertexClusters& clusters);

    [[nodiscard]] const transport::SurfaceMesh& mesh() const { return surface_->mesh; }
    [[nodiscard]] const Holes& holes() const { return holes_; }
    [[nodiscard]] const DrawnMaterial& material(std::uint32_t number) const {
        return materials_[number];
    }
    // The radiances of all terms of all vertices lie one after another: a vertex's first one is
    // at this place, its k-th one k places on.
    [[nodiscard]] std::uint32_t first_term(std::uint32_t vertex) const {
        return first_terms_[vertex];
    }
    [[nodiscard]] std::size_t term_count() const { return term_count_; }
    // Behind all terms: the place of what a vertex sends where that is given.
    [[nodiscard]] std::uint32_t given_term(std::uint32_t vertex) const {
        return static_cast<std::uint32_t>(term_count_) + vertex;
    }
    [[nodiscard]] const transport::VertexClusters& clusters() const { return clusters_; }
    // That a vertex is of.
    [[nodiscard]] std::uint32_t cluster(std::uint32_t vertex) const {
        return clusters_of_vertices_[vertex];
    }
    // The number of a vertex's material.
    [[nodiscard]] std::uint32_t material_of(std::uint32_t vertex) const {
        return clusters_.clusters()[cluster(vertex)].material;
    }
    // The most that one vertex has.
    [[nodiscard]] std::uint32_t most_terms() const { return most_terms_; }
    // Bytes of what it holds beside the transport.
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::shared_ptr<const transport::Surface> surface_;
    const transport::VertexClusters& clusters_;
    Holes holes_;
    std::vector<MippedTexture> textures_;
    std::vector<DrawnMaterial> materials_;
    std::vector<std::uint32_t> first_terms_;           // [vertices]
    std::vector<std::uint32_t> clusters_of_vertices_;  // [vertices]
    std::size_t term_count_ = 0;
    std::uint32_t most_terms_ = 0;
};

}  // namespace relume::view
