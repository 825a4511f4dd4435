// What people and clients look at beside the transport: albedo, depth, a picture, a thumbnail.
#pragma once

#include "precompute/bake/receivers/pixel/pixel_receivers.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::bake {

// height·width each.
struct ViewImages {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> coverage;
    std::vector<Imath::V3f> albedo;  // premultiplied by coverage
    std::vector<float> depth;  // along the view axis, world units; 0 where nothing is seen
};

// `unit`: of the scene's frame, in world units.
[[nodiscard]] ViewImages view_images(const PixelReceivers& pixels, double unit);

// Writes view/picture.png and its small copy view/thumbnail.png, relit from the finished
// transport in `directory`, of any kind, under a light of our own. Throws BakeError,
// files::FileError.
void write_pictures(const std::filesystem::path& directory);

// The same, and view/albedo.exr and view/depth.exr.
void write_view_files(const std::filesystem::path& directory, const ViewImages& view);

}  // namespace relume::bake
