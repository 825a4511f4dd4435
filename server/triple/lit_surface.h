// The vertices of a surface as triple products need them: where they are, and what each sees of
// the light. All sessions of a scene share one.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "protocol/transport/visibility_field.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::triple {

// Immutable; safe to share between threads.
class LitSurface {
  public:
    // The vertices of the mesh, whose visibility is that of the field's points, block by block.
    // `material_from_vertex`: [vertices]. Throws transport::TransportError where counts differ,
    // a normal is missing, or a frame of the field is broken. Takes 8·⌈6·n²/64⌉ bytes a vertex.
    LitSurface(const transport::SurfaceMesh& mesh,
               std::vector<std::uint32_t> material_from_vertex,
               const transport::VisibilityField& visibility);

    [[nodiscard]] std::uint32_t face_resolution() const { return n_; }
    [[nodiscard]] std::size_t vertex_count() const { return normals_.size(); }
    // One more than the highest of a vertex.
    [[nodiscard]] std::uint32_t material_count() const { return material_count_; }
    [[nodiscard]] std::uint32_t material(std::size_t vertex) const {
        return materials_[vertex];
    }
    [[nodiscard]] const Imath::V3f& normal(std::size_t vertex) const {
        return normals_[vertex];
    }
    // The mirrored direction to a viewer.
    [[nodiscard]] Imath::V3f reflection(std::size_t vertex, const Imath::V3f& eye) const;
    // A bit a texel, in squares (tripling/texel_blocks.h).
    [[nodiscard]] std::span<const std::uint64_t> open(std::size_t vertex) const {
        return std::span(open_).subspan(vertex * words_, words_);
    }
    [[nodiscard]] std::size_t byte_count() const;

  private:
    std::uint32_t n_;
    std::size_t words_;
    std::uint32_t material_count_ = 0;
    std::vector<Imath::V3f> positions_;
    std::vector<Imath::V3f> normals_;
    std::vector<std::uint32_t> materials_;
    std::vector<std::uint64_t> open_;
};

}  // namespace relume::triple
