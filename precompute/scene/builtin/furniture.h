// The pieces of the scene `table`.
#pragma once

#include "precompute/scene/builtin/mesh_builder.h"

#include <cstdint>
#include <vector>

namespace relume::scene {

inline constexpr float kTableHeight = 0.74F;
inline constexpr float kTableWidth = 1.24F;
inline constexpr float kInlayWidth = 1.06F;

// Everything but the inlay's surface: frame, aprons, legs. Centred on the origin.
void add_table(MeshBuilder& wood);
// Facing −Z, back towards +Z, centred on the origin.
void add_chair(MeshBuilder& wood);
void add_cushion(MeshBuilder& cloth);

// Centred on the origin, standing on y = 0.
void add_pot(MeshBuilder& clay);
void add_soil(MeshBuilder& soil);
void add_vase(MeshBuilder& glaze);
void add_bowl(MeshBuilder& metal);

// Stems growing out of a pot of add_pot's size; the leaves are dealt out over `leaves`, which
// stand for as many shades. The same for the same seed.
struct Foliage {
    MeshBuilder& stems;
    std::vector<MeshBuilder*> leaves;
};
void add_plant(const Foliage& foliage, std::uint64_t seed);

}  // namespace relume::scene
