#include "precompute/bake/rows/escape_sum.h"

#include "protocol/basis/cubemap.h"

namespace relume::bake {

void EscapeSum::reset(std::uint32_t face_resolution) {
    face_resolution_ = face_resolution;
    nodes_.assign(basis::texel_count(face_resolution), EscapeNode{});
}

void EscapeSum::add(const SurfacePaths& paths, float weight) {
    const float each = weight / static_cast<float>(paths.paths);
    const std::uint32_t* texel = paths.texels.data();
    for (const Escapes& escapes : paths.escapes) {
        const Imath::V3f value = escapes.weight * each;
        const float square = value.length2();
        for (const std::uint32_t* end = texel + escapes.count; texel != end; ++texel) {
            EscapeNode& node = nodes_[*texel];
            node.sum += value;
            node.squares += square;
        }
    }
}

}  // namespace relume::bake
