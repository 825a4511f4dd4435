// The relit image from the sums of its blocks.
#pragma once

#include "server/engine/scene.h"

#include <span>

namespace relume::engine {

// `sums` are before tint, in the basis of the blocks (receiver_basis.h): [blocks][3][256]. The
// image has the tint applied: interleaved RGB, row by row from the top, 3·width·height floats
// (throws std::invalid_argument otherwise), linear radiance, premultiplied by coverage.
void write_relit_image(const Scene& scene, std::span<const float> sums, std::span<float> rgb);

}  // namespace relume::engine
