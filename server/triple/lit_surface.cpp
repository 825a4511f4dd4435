#include "server/triple/lit_surface.h"

#include "protocol/transport/error.h"
#include "protocol/tripling/material_field.h"
#include "protocol/tripling/texel_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace relume::triple {
namespace {

void require_as_many(const char* what, std::size_t found, std::size_t vertices) {
    if (found != vertices) {
        throw transport::TransportError(fmt::format(
            "{}: found {}, expected {}, as many as vertices", what, found, vertices));
    }
}

}  // namespace

LitSurface::LitSurface(const transport::SurfaceMesh& mesh,
                       std::vector<std::uint32_t> material_from_vertex,
                       const transport::VisibilityField& visibility)
    : n_(visibility.face_resolution()),
      words_(visibility.words_per_point()),
      positions_(mesh.positions),
      normals_(mesh.normals),
      materials_(std::move(material_from_vertex)) {
    require_as_many("normals", normals_.size(), mesh.vertex_count());
    require_as_many("materials of vertices", materials_.size(), mesh.vertex_count());
    require_as_many("points of the visibility", visibility.point_count(), mesh.vertex_count());
    for (const std::uint32_t material : materials_) {
        material_count_ = std::max(material_count_, material + 1);
    }
    open_.resize(mesh.vertex_count() * words_);
    std::size_t vertex = 0;
    std::vector<std::uint64_t> bits;
    for (std::uint32_t block = 0; block < visibility.block_count(); ++block) {
        visibility.read(block, bits);
        for (std::size_t first = 0; first < bits.size(); first += words_, ++vertex) {
            tripling::bits_in_blocks(n_, std::span(bits).subspan(first, words_),
                                     std::span(open_).subspan(vertex * words_, words_));
        }
    }
}

Imath::V3f LitSurface::reflection(std::size_t vertex, const Imath::V3f& eye) const {
    const Imath::V3f viewer = (eye - positions_[vertex]).normalized();
    // An eye at the vertex looks straight at it.
    return viewer.length2() > 0 ? tripling::mirrored(viewer, normals_[vertex])
                                : normals_[vertex];
}

std::size_t LitSurface::byte_count() const {
    return std::as_bytes(std::span(positions_)).size() +
           std::as_bytes(std::span(normals_)).size() +
           std::as_bytes(std::span(materials_)).size() + std::as_bytes(std::span(open_)).size();
}

}  // namespace relume::triple
