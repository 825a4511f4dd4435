// A material as functions of the direction to the light, tabulated over the surface's normal
// and the mirrored direction to the viewer [Ng04 §7.1.2].
//
// ρ̃(n, ω_r, ω), cosine and solid angle included: texel t of an entry is
// ∫_t ρ(ω, ω_o) max(ω·n, 0) dω, with ω_o the mirror image of ω_r about n. Highlights follow
// ω_r, so that few normals are enough. A Lambertian material depends on n alone and a Phong
// highlight on ω_r alone; the other grid then has one node. What has several colours, or parts
// that are multiplied by colours, has a function for each of them: its *lobes*.
#pragma once

#include "protocol/tripling/direction_grid.h"
#include "protocol/tripling/wavelet_store.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::tripling {

// Immutable once made; then safe to share between threads.
struct MaterialField {
    static constexpr std::size_t kMostLobes = 4;
    static constexpr std::size_t kMostNameBytes = 255;

    std::string name;
    DirectionGrid normals{1};
    DirectionGrid reflections{1};
    float energy_fraction = 1;        // of every entry's squares, at least; 1: all
    std::vector<WaveletStore> lobes;  // each with an entry for every pair of nodes
    // [lobes], what each is multiplied with where nobody says otherwise.
    std::vector<Imath::V3f> colours;

    [[nodiscard]] std::uint32_t face_resolution() const {
        return lobes.front().face_resolution();
    }
    [[nodiscard]] std::size_t entry_count() const {
        return normals.node_count() * reflections.node_count();
    }
    [[nodiscard]] std::size_t entry_index(std::size_t normal, std::size_t reflection) const {
        return normal * reflections.node_count() + reflection;
    }
    [[nodiscard]] std::size_t byte_count() const;
};

// Where a surface point and its viewer lie in a field: the entries whose weights are not zero,
// at most sixteen. Weights add up to 1.
struct FieldPlace {
    struct Entry {
        std::size_t index = 0;
        float weight = 0;
    };
    std::array<Entry, 16> entries;
    std::size_t count = 0;
};

// The mirror image of a direction about a normal, both unit.
[[nodiscard]] inline Imath::V3f mirrored(const Imath::V3f& direction,
                                         const Imath::V3f& normal) {
    return normal * (2 * direction.dot(normal)) - direction;
}

// Quadrilinear: continuous in both directions. `normal` and `reflection` are unit.
[[nodiscard]] FieldPlace place_in_grids(const DirectionGrid& normals,
                                        const DirectionGrid& reflections,
                                        const Imath::V3f& normal,
                                        const Imath::V3f& reflection);
[[nodiscard]] FieldPlace place_in_field(const MaterialField& field,
                                        const Imath::V3f& normal,
                                        const Imath::V3f& reflection);

}  // namespace relume::tripling
