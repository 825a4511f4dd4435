// Where the paths of a receiver and its neighbours left the scene, by texel.
#pragma once

#include "precompute/bake/rows/path_tracer.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// What falls into a texel, and the sum of the squares of what it is made of.
struct EscapeNode {
    Imath::V3f sum{0, 0, 0};
    float squares = 0;
};

// Reused from receiver to receiver; one per thread.
class EscapeSum {
  public:
    // Forgets all.
    void reset(std::uint32_t face_resolution);
    // Adds weight · (mean of the paths).
    void add(const SurfacePaths& paths, float weight);
    // The same, each path times a factor of its own, [starts].
    void add(const SurfacePaths& paths, float weight, std::span<const float> factors);

    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    // By texel_key, 6·n².
    [[nodiscard]] std::span<EscapeNode> nodes() { return nodes_; }
    [[nodiscard]] std::span<const EscapeNode> nodes() const { return nodes_; }

  private:
    void add_texels(std::span<const std::uint32_t> texels, const Imath::V3f& value);

    std::uint32_t face_resolution_ = 0;
    std::vector<EscapeNode> nodes_;
};

}  // namespace relume::bake
