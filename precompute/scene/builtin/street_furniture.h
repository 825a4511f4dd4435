// The pieces of the scene `street`. Each stands on y = 0, is centred on the origin and closed,
// with its front towards +Z.
#pragma once

#include "precompute/scene/builtin/mesh_builder.h"

#include <cstdint>

namespace relume::scene {

// A tapering post whose arm bends over to +Z, and the lamp that hangs from it.
void add_lamp_post(MeshBuilder& paint);
void add_lamp_shade(MeshBuilder& paint);
void add_lamp_globe(MeshBuilder& glass);

void add_bench_slats(MeshBuilder& wood);
void add_bench_frame(MeshBuilder& iron);
void add_bollard(MeshBuilder& paint);
// A letter box like a pillar.
void add_pillar_box(MeshBuilder& lacquer);
void add_pillar_box_foot(MeshBuilder& paint);

// The same for the same seed.
void add_trunk(MeshBuilder& bark, std::uint32_t seed);
void add_crown(MeshBuilder& leaves, std::uint32_t seed);

}  // namespace relume::scene
