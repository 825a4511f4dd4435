#include "server/net/images/sky_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace relume::net {
namespace {

// Calls see(x) for every pixel of a row through which the environment is seen.
template <typename See>
void for_each_sky_pixel(std::span<const float> coverage_of_row, const See& see) {
    for (std::uint32_t x = 0; x < coverage_of_row.size(); ++x) {
        if (coverage_of_row[x] < 1) {
            see(x);
        }
    }
}

// Where the parts of every row begin, and where the last one ends.
std::vector<std::size_t> begins_from_counts(const std::vector<std::size_t>& counts) {
    std::vector<std::size_t> begins(counts.size() + 1, 0);
    std::inclusive_scan(counts.begin(), counts.end(), begins.begin() + 1);
    return begins;
}

}  // namespace

SkyPixels::SkyPixels(const view::View& view) : image_(view.image()) {
    coverage_.resize(std::size_t{image_.width} * image_.height);
    view.write_coverage(coverage_);
    std::vector<std::size_t> pixels(image_.height, 0);
    std::vector<std::size_t> runs(image_.height, 0);
    tbb::parallel_for(std::uint32_t{0}, image_.height, [&](std::uint32_t y) {
        std::uint32_t end_of_run = 0;
        for_each_sky_pixel(coverage_of_row(y), [&](std::uint32_t x) {
            runs[y] += pixels[y] == 0 || x != end_of_run ? 1U : 0U;
            ++pixels[y];
            end_of_run = x + 1;
        });
    });
    const std::vector<std::size_t> pixel_begins = begins_from_counts(pixels);
    row_begins_ = begins_from_counts(runs);
    size_ = pixel_begins.back();
    runs_.resize(row_begins_.back());
    looks_.resize((size_ + light::kLooksPerRun - 1) / light::kLooksPerRun);
    for (std::size_t i = 0; i < looks_.size(); ++i) {
        looks_[i].count = static_cast<std::uint32_t>(
            std::min(light::kLooksPerRun, size_ - i * light::kLooksPerRun));
    }
    tbb::parallel_for(std::uint32_t{0}, image_.height,
                      [&](std::uint32_t y) { fill_row(view.camera(), y, pixel_begins[y]); });
}

void SkyPixels::fill_row(const transport::CameraRecord& camera,
                         std::uint32_t y,
                         std::size_t place) {
    const float plane_area_of_pixel = 4 * camera.tan_half_width * camera.tan_half_height /
                                      static_cast<float>(image_.width) /
                                      static_cast<float>(image_.height);
    SkyRun* run = runs_.data() + row_begins_[y];
    SkyRun* const first_run = run;
    for_each_sky_pixel(coverage_of_row(y), [&](std::uint32_t x) {
        if (run != first_run && (run - 1)->x + (run - 1)->count == x) {
            ++(run - 1)->count;
        } else {
            *run++ = {.x = x, .count = 1, .place = static_cast<std::uint32_t>(place)};
        }
        const Imath::V3f direction = camera.direction_from_pixel(
            static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, image_);
        // A pixel of the image plane at distance 1 seen under the angle θ: area · cos³ θ.
        const float cosine = direction.dot(camera.forward);
        SkyLooks& looks = looks_[place / light::kLooksPerRun];
        const std::size_t look = place % light::kLooksPerRun;
        looks.directions.set(look, direction.x, direction.y, direction.z);
        looks.footprints_sr[look] = plane_area_of_pixel * cosine * cosine * cosine;
        looks.visible[look] = 1 - coverage_of_row(y)[x];
        ++place;
    });
}

}  // namespace relume::net
