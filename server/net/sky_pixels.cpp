#include "server/net/sky_pixels.h"

namespace relume::net {

SkyPixels::SkyPixels(const transport::Transport& transport) {
    const transport::TileGrid& image = transport.manifest().image;
    const transport::CameraRecord& camera = transport.manifest().camera;
    const std::span<const float> coverage_of_slot = transport.coverage();
    const float plane_area_of_pixel = 4 * camera.tan_half_width * camera.tan_half_height /
                                      static_cast<float>(image.width) /
                                      static_cast<float>(image.height);
    coverage_.reserve(std::size_t{image.width} * image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const transport::Receiver receiver = image.receiver_from_pixel(x, y);
            const float coverage =
                coverage_of_slot[std::size_t{receiver.block} * transport::kBlockSize +
                                 receiver.slot];
            coverage_.push_back(coverage);
            if (coverage >= 1) {
                continue;
            }
            const Imath::V3f direction = camera.direction_from_pixel(
                static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, image);
            // A pixel of the image plane at distance 1 seen under the angle θ: area · cos³ θ.
            const float cosine = direction.dot(camera.forward);
            pixels_.push_back({.index = y * image.width + x,
                               .visible = 1 - coverage,
                               .direction = direction,
                               .footprint_sr = plane_area_of_pixel * cosine * cosine * cosine});
        }
    }
}

}  // namespace relume::net
