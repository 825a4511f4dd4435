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
        add_texels({texel, escapes.count}, escapes.weight * each);
        texel += escapes.count;
    }
}

void EscapeSum::add(const SurfacePaths& paths, float weight, std::span<const float> factors) {
    const float each = weight / static_cast<float>(paths.paths);
    const std::uint32_t* texel = paths.texels.data();
    for (std::size_t path = 0; path < factors.size(); ++path) {
        const std::size_t last = path + 1 < factors.size() ? paths.starts[path + 1].first_escape
                                                           : paths.escapes.size();
        for (std::size_t i = paths.starts[path].first_escape; i < last; ++i) {
            const Escapes& escapes = paths.escapes[i];
            add_texels({texel, escapes.count}, escapes.weight * (each * factors[path]));
            texel += escapes.count;
        }
    }
}

void EscapeSum::add_texels(std::span<const std::uint32_t> texels, const Imath::V3f& value) {
    const float square = value.length2();
    for (const std::uint32_t texel : texels) {
        EscapeNode& node = nodes_[texel];
        node.sum += value;
        node.squares += square;
    }
}

}  // namespace relume::bake
