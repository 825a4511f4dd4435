#include "server/net/images/sky_pixels.h"

namespace relume::net {

SkyPixels::SkyPixels(const view::View& view) {
    const transport::TileGrid& image = view.image();
    const transport::CameraRecord& camera = view.camera();
    const float plane_area_of_pixel = 4 * camera.tan_half_width * camera.tan_half_height /
                                      static_cast<float>(image.width) /
                                      static_cast<float>(image.height);
    coverage_.resize(std::size_t{image.width} * image.height);
    view.write_coverage(coverage_);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        row_begins_.push_back(runs_.size());
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const float coverage = coverage_[std::size_t{y} * image.width + x];
            if (coverage >= 1) {
                continue;
            }
            const Imath::V3f direction = camera.direction_from_pixel(
                static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, image);
            // A pixel of the image plane at distance 1 seen under the angle θ: area · cos³ θ.
            const float cosine = direction.dot(camera.forward);
            append(x, direction, plane_area_of_pixel * cosine * cosine * cosine, 1 - coverage);
        }
    }
    row_begins_.push_back(runs_.size());
}

void SkyPixels::append(std::uint32_t x,
                       const Imath::V3f& direction,
                       float footprint_sr,
                       float visible) {
    const bool row_has_run = runs_.size() > row_begins_.back();
    if (row_has_run && runs_.back().x + runs_.back().count == x) {
        ++runs_.back().count;
    } else {
        runs_.push_back({.x = x, .count = 1, .place = static_cast<std::uint32_t>(size_)});
    }
    if (looks_.empty() || looks_.back().count == light::kLooksPerRun) {
        looks_.emplace_back();
    }
    SkyLooks& looks = looks_.back();
    looks.directions.set(looks.count, direction.x, direction.y, direction.z);
    looks.footprints_sr[looks.count] = footprint_sr;
    looks.visible[looks.count] = visible;
    ++looks.count;
    ++size_;
}

}  // namespace relume::net
