#include "server/net/frame_composer.h"

#include "server/light/background.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace relume::net {

namespace {

// Pixels per task: enough work to be worth a task, and few enough to spread an image.
constexpr std::size_t kGrain = 4096;

template <typename Body>
void for_ranges(std::size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          body(range.begin(), range.end());
                      });
}

// What the environment shows in up to kLooksPerRun pixels.
void look(const light::Background& background,
          std::span<const SkyPixel> pixels,
          std::span<Imath::V3f> radiances) {
    light::LookDirections directions;
    std::array<float, light::kLooksPerRun> footprints_sr;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Imath::V3f& direction = pixels[i].direction;
        directions.set(i, direction.x, direction.y, direction.z);
        footprints_sr[i] = pixels[i].footprint_sr;
    }
    background.radiances(directions, std::span(footprints_sr).first(pixels.size()), radiances);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        radiances[i] *= pixels[i].visible;
    }
}

}  // namespace

FrameComposer::FrameComposer(const SkyPixels& sky, std::uint32_t width, std::uint32_t height)
    : sky_(sky),
      width_(width),
      height_(height),
      background_(sky.pixels().size(), Imath::V3f(0)),
      rgb_(std::size_t{3} * width * height) {}

void FrameComposer::set_background(const wire::Background& background,
                                   const light::LightRig& rig) {
    has_alpha_ = background.mode == wire::BackgroundMode::transparent;
    const std::span<const SkyPixel> pixels = sky_.pixels();
    if (background.mode != wire::BackgroundMode::environment) {
        const Imath::V3f colour = has_alpha_ ? Imath::V3f(0) : Imath::V3f(background.colour);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            background_[i] = colour * pixels[i].visible;
        }
        return;
    }
    const light::Background lookup(rig);
    for_ranges(pixels.size(), [&](std::size_t begin, std::size_t end) {
        for (; begin < end; begin += light::kLooksPerRun) {
            const std::size_t count = std::min(light::kLooksPerRun, end - begin);
            look(lookup, pixels.subspan(begin, count),
                 std::span(background_).subspan(begin, count));
        }
    });
}

void FrameComposer::compose(const engine::Session& session) {
    session.write_image(rgb_);
    const std::span<const SkyPixel> pixels = sky_.pixels();
    for_ranges(pixels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            float* const rgb = &rgb_[std::size_t{3} * pixels[i].index];
            rgb[0] += background_[i].x;
            rgb[1] += background_[i].y;
            rgb[2] += background_[i].z;
        }
    });
}

void FrameComposer::write_codes(const DisplayTable& table,
                                std::span<std::uint8_t> codes) const {
    for_ranges(rgb_.size(), [&](std::size_t begin, std::size_t end) {
        table.codes(std::span(rgb_).subspan(begin, end - begin),
                    codes.subspan(begin, end - begin));
    });
}

const wire::HalfImage& FrameComposer::half_image() {
    const std::size_t pixel_count = std::size_t{width_} * height_;
    half_.width = width_;
    half_.height = height_;
    half_.has_alpha = has_alpha_;
    half_.values.resize(pixel_count * half_.plane_count());
    for_ranges(pixel_count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                half_.values[c * pixel_count + i] = wire::half_from_linear(rgb_[3 * i + c]);
            }
            if (has_alpha_) {
                half_.values[3 * pixel_count + i] = wire::half_from_linear(sky_.coverage()[i]);
            }
        }
    });
    return half_;
}

}  // namespace relume::net
