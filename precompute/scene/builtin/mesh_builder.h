// Shapes out of which the built-in scenes are made. Every call appends to one mesh.
#pragma once

#include "precompute/scene/mesh.h"

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace relume::scene {

// A point of a tube's axis and the tube's radius there.
struct TubePoint {
    Imath::V3f centre;
    float radius;
};

// A point of a turned shape's outline.
struct ProfilePoint {
    float radius;
    float height;
};

enum class Closing : std::uint8_t { open, closed };

class MeshBuilder {
  public:
    MeshBuilder(std::string name, std::uint32_t material);

    // Applied to everything added from now on; without scale or mirror.
    void place(const Imath::M44f& to_world) { to_world_ = to_world; }

    // Counter-clockwise seen from the front; flat. Texture coordinates span the quad once.
    void add_quad(const Imath::V3f& p0,
                  const Imath::V3f& p1,
                  const Imath::V3f& p2,
                  const Imath::V3f& p3);
    // Six flat sides. Texture coordinates in the mesh's units, u along the longest edge, so
    // that grain runs along a bar.
    void add_box(const Imath::V3f& centre, const Imath::V3f& size);
    // A box whose ends differ: from `bottom` with sides `bottom_size` (x, z) to `top`.
    void add_tapered_bar(const Imath::V3f& bottom,
                         const Imath::V2f& bottom_size,
                         const Imath::V3f& top,
                         const Imath::V2f& top_size);
    // Smooth; at least two points. Closed ends are flat caps.
    void add_tube(const std::vector<TubePoint>& axis, std::uint32_t sides, Closing ends);
    // The outline turned around +Y; smooth. Seen from outside where the outline runs upwards.
    void add_lathe(const std::vector<ProfilePoint>& outline, std::uint32_t segments);
    void add_sphere(const Imath::V3f& centre, float radius, std::uint32_t segments);
    // Points position(i, j), 0 ≤ i < rows, 0 ≤ j < columns, joined to a smooth surface; a
    // closed direction joins its last to its first. Coinciding neighbours (poles) are allowed.
    // Seen from the side from which columns run to the right where rows run upwards.
    void add_grid(std::uint32_t rows,
                  std::uint32_t columns,
                  Closing along_rows,
                  Closing along_columns,
                  const std::function<Imath::V3f(std::uint32_t, std::uint32_t)>& position);

    // The triangles of another mesh of this builder's kind, moved.
    void add_mesh(const Mesh& mesh, const Imath::V3f& offset);

    // Takes the mesh out; the builder is empty after.
    [[nodiscard]] Mesh take();

  private:
    std::uint32_t add_vertex(const Imath::V3f& position,
                             const Imath::V3f& normal,
                             const Imath::V2f& uv);
    void add_flat_quad(const Imath::V3f& p0,
                       const Imath::V3f& p1,
                       const Imath::V3f& p2,
                       const Imath::V3f& p3,
                       const Imath::V2f& uv_size);
    void add_bar(const Imath::V3f (&corners)[8]);

    Mesh mesh_;
    Imath::M44f to_world_;
};

// Turned by `degrees` around +Y, then moved.
[[nodiscard]] Imath::M44f placed(const Imath::V3f& position, float degrees_around_y);

}  // namespace relume::scene
