#include "server/net/images/frame_composer.h"

#include "protocol/light/background.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace relume::net {

namespace {

// Runs of sky pixels per task: enough work to be worth one, few enough to spread an image.
constexpr std::size_t kLooksPerTask = 64;
// Tiles per task: their linear pixels, 48 kB, stay in the second-level cache.
constexpr std::uint32_t kTilesPerRun = 16;

// What the environment shows in these pixels.
void look_up(const light::Background& background,
             const SkyLooks& pixels,
             std::span<Imath::V3f> radiances) {
    background.radiances(pixels.directions, std::span(pixels.footprints_sr).first(pixels.count),
                         radiances);
    for (std::size_t i = 0; i < pixels.count; ++i) {
        radiances[i] *= pixels.visible[i];
    }
}

}  // namespace

FrameComposer::FrameComposer(std::unique_ptr<view::View> view,
                             std::shared_ptr<const SkyPixels> sky)
    : view_(std::move(view)), sky_(std::move(sky)), image_(view_->image()) {}

bool FrameComposer::look(const view::Look& look) {
    const bool changed = view_->look(look);
    if (changed) {
        sky_.reset();
    }
    return changed;
}

bool FrameComposer::look_closer() {
    const bool changed = view_->look_closer();
    if (changed) {
        sky_.reset();
    }
    return changed;
}

void FrameComposer::set_background(const wire::Background& background,
                                   const light::LightRig& rig) {
    if (!sky_) {
        sky_ = std::make_shared<const SkyPixels>(*view_);
    }
    background_.resize(sky_->size());
    has_alpha_ = background.mode == wire::BackgroundMode::transparent;
    const bool sees_environment = background.mode == wire::BackgroundMode::environment;
    const Imath::V3f colour = has_alpha_ ? Imath::V3f(0) : Imath::V3f(background.colour);
    const light::Background lookup(rig);
    const std::span<const SkyLooks> looks = sky_->looks();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, looks.size(), kLooksPerTask),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const std::span<Imath::V3f> seen =
                    std::span(background_).subspan(k * light::kLooksPerRun, looks[k].count);
                if (sees_environment) {
                    look_up(lookup, looks[k], seen);
                    continue;
                }
                for (std::size_t i = 0; i < seen.size(); ++i) {
                    seen[i] = colour * looks[k].visible[i];
                }
            }
        });
}

// Calls take(index of the first pixel, linear pixels) for parts of rows that together are the
// image, in no order and at the same time.
template <typename Take>
void FrameComposer::for_each_row(std::span<const float> sums, const Take& take) const {
    const std::uint32_t runs_x = (image_.tiles_x() + kTilesPerRun - 1) / kTilesPerRun;
    tbb::parallel_for(std::uint32_t{0}, runs_x * image_.tiles_y(), [&](std::uint32_t run) {
        const std::uint32_t first = run % runs_x * kTilesPerRun;
        const view::TileRun tiles{.row = run / runs_x,
                                  .first = first,
                                  .last = std::min(first + kTilesPerRun, image_.tiles_x())};
        const view::PixelRect pixels = view::pixels_of(image_, tiles);
        const std::size_t row_floats = std::size_t{3} * pixels.width;
        thread_local std::vector<float> rgb;
        rgb.resize(row_floats * pixels.height);
        view_->write_tiles(sums, tiles, rgb);
        for (std::uint32_t y = 0; y < pixels.height; ++y) {
            const std::span<float> row = std::span(rgb).subspan(y * row_floats, row_floats);
            add_background(pixels.left, pixels.top + y, row);
            take(std::size_t{pixels.top + y} * image_.width + pixels.left, row);
        }
    });
}

void FrameComposer::add_background(std::uint32_t x,
                                   std::uint32_t y,
                                   std::span<float> rgb) const {
    const std::uint32_t end = x + static_cast<std::uint32_t>(rgb.size() / 3);
    for (const SkyRun& run : sky_->runs_of_row(y)) {
        const std::uint32_t first = std::max(run.x, x);
        const std::uint32_t last = std::min(run.x + run.count, end);
        if (first >= last) {
            continue;
        }
        const float* const background = &background_[run.place + (first - run.x)].x;
        float* const seen = &rgb[std::size_t{3} * (first - x)];
        for (std::size_t i = 0; i < std::size_t{3} * (last - first); ++i) {
            seen[i] += background[i];
        }
    }
}

void FrameComposer::compose(std::span<const float> sums,
                            std::span<const DisplayTable* const> displays,
                            bool half_planes) {
    image_ = view_->image();
    view_->begin_image(sums);
    const std::size_t pixel_count = std::size_t{image_.width} * image_.height;
    codes_.resize(displays.size());
    for (std::vector<std::uint8_t>& codes : codes_) {
        codes.resize(3 * pixel_count);
    }
    if (half_planes) {
        half_.width = image_.width;
        half_.height = image_.height;
        half_.has_alpha = has_alpha_;
        half_.values.resize(pixel_count * half_.plane_count());
    }
    for_each_row(sums, [&](std::size_t index, std::span<const float> rgb) {
        for (std::size_t i = 0; i < displays.size(); ++i) {
            displays[i]->codes(rgb, std::span(codes_[i]).subspan(3 * index, rgb.size()));
        }
        if (half_planes) {
            put_half(index, rgb);
        }
    });
}

void FrameComposer::put_half(std::size_t index, std::span<const float> rgb) {
    const std::size_t pixel_count = std::size_t{image_.width} * image_.height;
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            half_.values[c * pixel_count + index + i] = wire::half_from_linear(rgb[3 * i + c]);
        }
        if (has_alpha_) {
            half_.values[3 * pixel_count + index + i] =
                wire::half_from_linear(sky_->coverage()[index + i]);
        }
    }
}

}  // namespace relume::net
