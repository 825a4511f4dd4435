// What an image will show, before it is baked.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"

#include <filesystem>

namespace relume::bake {

// Throws BakeError, with the bounds of the scene and the camera, where no pixel sees a surface.
void check_framing(const scene::Scene& scene, const PixelReceivers& pixels);

// A PNG of the scene as the camera sees it, lit from the viewer's side, without shadows: a
// picture of the framing, of the size of the image. Throws BakeError, also where no pixel sees
// a surface.
void write_preview(const std::filesystem::path& path,
                   const scene::Scene& scene,
                   const BakeParameters& parameters);

}  // namespace relume::bake
