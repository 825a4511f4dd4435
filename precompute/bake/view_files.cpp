#include "precompute/bake/view_files.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/image_file.h"
#include "precompute/bake/relight.h"
#include "protocol/basis/cubemap.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

constexpr std::uint32_t kThumbnailSide = 384;

// What a stranger judges the bake by: a soft key light over the viewer's left shoulder, under a
// pale sky.
CubemapLight thumbnail_light(std::uint32_t n, const transport::CameraRecord& camera) {
    const Imath::V3f key =
        (camera.up * 0.9F - camera.right * 0.7F - camera.forward * 0.5F).normalized();
    const Imath::V3f key_colour{9.0F, 8.2F, 7.0F};
    const Imath::V3f sky_colour{0.45F, 0.58F, 0.8F};
    const Imath::V3f ground_colour{0.22F, 0.2F, 0.18F};
    CubemapLight light;
    for (auto& plane : light) {
        plane.resize(basis::texel_count(n));
    }
    for (std::size_t texel = 0; texel < light[0].size(); ++texel) {
        const Imath::V3f direction =
            basis::direction_from_texel(n, basis::texel_from_index(n, texel));
        const float height = std::clamp(0.5F + 2 * direction.y, 0.0F, 1.0F);
        const float in_key = std::clamp((direction.dot(key) - 0.9F) / 0.06F, 0.0F, 1.0F);
        const Imath::V3f radiance =
            ground_colour + (sky_colour - ground_colour) * height + key_colour * in_key;
        for (std::size_t c = 0; c < 3; ++c) {
            light[c][texel] = radiance[static_cast<int>(c)];
        }
    }
    return light;
}

// The contract's filmic curve (protocol/README.md §3.2), then sRGB.
float displayed(float x) {
    const float film =
        std::clamp(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
    return film <= 0.0031308F ? 12.92F * film : 1.055F * std::pow(film, 1 / 2.4F) - 0.055F;
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw BakeError(fmt::format("{}: cannot create: {}", folder.string(), error.message()));
    }
}

}  // namespace

void write_pictures(const std::filesystem::path& directory) {
    make_folder(directory / "view");
    const auto transport = transport::Transport::open(directory);
    const transport::Manifest& manifest = transport->manifest();
    const basis::SignalBasis& basis = manifest.signal_basis;
    const DenseImage relit = relight(
        *transport, basis.is_of_light()
                        ? coefficients_of_light(
                              *transport, thumbnail_light(basis.cubemap().face_resolution(),
                                                          manifest.camera))
                        : coefficients_as_baked(*transport));
    constexpr float kBackdrop = 0.12F;
    std::vector<float> pixels;
    for (std::size_t i = 0; i < relit.coverage.size(); ++i) {
        for (const auto& plane : relit.rgb) {
            pixels.push_back(static_cast<float>(plane[i]) +
                             (1 - relit.coverage[i]) * kBackdrop);
        }
    }
    const float scale =
        std::min(1.0F, static_cast<float>(kThumbnailSide) /
                           static_cast<float>(std::max(relit.width, relit.height)));
    const auto scaled = [scale](std::uint32_t side) {
        return std::max(
            1U, static_cast<std::uint32_t>(std::lround(scale * static_cast<float>(side))));
    };
    FloatImage image{relit.width, relit.height, 3, std::move(pixels)};
    FloatImage small = resized(image, scaled(relit.width), scaled(relit.height));
    for (FloatImage* shown : {&image, &small}) {
        for (float& value : shown->values) {
            value = displayed(std::max(value, 0.0F));
        }
    }
    write_png(directory / "view" / "picture.png", image);
    write_png(directory / "view" / "thumbnail.png", small);
}

ViewImages view_images(const PixelReceivers& pixels, double unit) {
    const auto& [width, height] = pixels.image();
    const std::size_t count = std::size_t{width} * height;
    ViewImages view{.width = width,
                    .height = height,
                    .coverage = std::vector<float>(count),
                    .albedo = std::vector<Imath::V3f>(count),
                    .depth = std::vector<float>(count)};
    tbb::parallel_for(std::uint32_t{0}, view.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < view.width; ++x) {
            const PixelView pixel = pixels.view(x, y);
            const std::size_t i = std::size_t{y} * view.width + x;
            view.coverage[i] = pixel.coverage;
            view.albedo[i] = pixel.albedo;
            view.depth[i] = pixel.depth * static_cast<float>(unit);
        }
    });
    return view;
}

void write_view_files(const std::filesystem::path& directory, const ViewImages& view) {
    make_folder(directory / "view");
    std::vector<float> albedo;
    for (const Imath::V3f& colour : view.albedo) {
        albedo.insert(albedo.end(), {colour.x, colour.y, colour.z});
    }
    write_exr(directory / "view" / "albedo.exr", {view.width, view.height, 3, albedo});
    write_exr(directory / "view" / "depth.exr", {view.width, view.height, 1, view.depth});
    write_pictures(directory);
}

}  // namespace relume::bake
