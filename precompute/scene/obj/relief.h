// Pictures of one value a texel, and heights as normals.
#pragma once

#include "precompute/scene/obj/mtl_file.h"
#include "precompute/scene/texture.h"

#include <Imath/ImathVec.h>

#include <functional>

namespace relume::scene::obj {

using Channel = std::function<float(const Imath::V4f&)>;

// What -imfchan says of a texel; luminance unless it says otherwise.
[[nodiscard]] Channel value_channel(const MtlTexture& how);
// The same for map_d, which is the alpha of a picture that has one.
[[nodiscard]] Channel mask_channel(const Texture& picture, const MtlTexture& how);

// Whether a picture shows directions about +Z rather than heights: mostly bluish.
[[nodiscard]] bool is_normal_map(const Texture& picture);

// The normal map of a height field: slopes are differences of height between neighbouring
// texels times `strength`, so that heights from 0 to 1 at strength 1 rise by a texel's width.
[[nodiscard]] Texture normals_from_height(const Texture& heights,
                                          const Channel& channel,
                                          float strength);

}  // namespace relume::scene::obj
