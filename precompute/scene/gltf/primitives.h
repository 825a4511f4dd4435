// One primitive of a mesh, read: triangles and vertices in the mesh's own coordinates.
#pragma once

#include "precompute/scene/gltf/accessors.h"
#include "precompute/scene/gltf/materials.h"
#include "precompute/scene/mesh.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// Which joints move a vertex: `per_vertex` of them, vertex after vertex.
struct Influences {
    std::size_t per_vertex = 0;  // 0: the primitive has none
    std::vector<std::uint32_t> joints{};
    std::vector<float> weights{};
};

struct PrimitiveShape {
    Mesh mesh;  // all but name and positions; only vertices that a triangle has
    std::vector<Imath::V3d> positions{};
    Influences influences{};
};

// What was left out of primitives, all together.
struct LeftOut {
    std::uint64_t points_and_lines = 0;
    std::uint64_t loose_indices = 0;  // one or two after the last whole triangle
};

class PrimitiveReader {
  public:
    // All must outlive this.
    PrimitiveReader(const Document& document,
                    BufferViews& views,
                    Accessors& accessors,
                    Materials& materials,
                    ImportReport& report)
        : document_(document),
          views_(views),
          accessors_(accessors),
          materials_(materials),
          report_(report) {}

    // `morph_weights`: one for each morph target, missing ones zero. Nothing for points and
    // lines. `who` names the primitive. Throws SceneError.
    [[nodiscard]] std::optional<PrimitiveShape> read(const tinygltf::Primitive& primitive,
                                                     std::span<const double> morph_weights,
                                                     bool is_skinned,
                                                     const std::string& who);
    [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

  private:
    const Document& document_;
    BufferViews& views_;
    Accessors& accessors_;
    Materials& materials_;
    ImportReport& report_;
    LeftOut left_out_{};
};

}  // namespace relume::scene::gltf
