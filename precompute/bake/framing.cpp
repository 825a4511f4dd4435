#include "precompute/bake/framing.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/image_file.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/srgb.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {
namespace {

// Rows far apart first, so that a scene in view is found soon.
constexpr std::uint32_t kRowStride = 16;

bool sees_something(const PixelReceivers& pixels) {
    const transport::TileGrid& image = pixels.image();
    std::atomic<bool> found = false;
    for (std::uint32_t first = 0; first < std::min(kRowStride, image.height); ++first) {
        const std::uint32_t rows = (image.height - first - 1) / kRowStride + 1;
        tbb::parallel_for(std::uint32_t{0}, rows, [&](std::uint32_t row) {
            const std::uint32_t y = first + row * kRowStride;
            for (std::uint32_t x = 0; x < image.width && !found; ++x) {
                if (!pixels.view(x, y).surfaces.empty()) {
                    found = true;
                }
            }
        });
        if (found) {
            return true;
        }
    }
    return false;
}

}  // namespace

void check_framing(const scene::Scene& scene, const PixelReceivers& pixels) {
    if (sees_something(pixels)) {
        return;
    }
    const scene::Camera& camera = pixels.camera();
    const Imath::Box3f box = scene.bounds();
    const Imath::V3d eye = scene.frame.world_from_position(camera.eye());
    const Imath::V3f& forward = camera.forward();
    throw BakeError(fmt::format(
        "the image is empty: no pixel sees a surface. The scene reaches from ({:g}, {:g}, "
        "{:g}) "
        "to ({:g}, {:g}, {:g}); the camera '{}' stands at ({:g}, {:g}, {:g}) and looks along "
        "({:.3g}, {:.3g}, {:.3g}), +Y up. --camera, --eye and --look-at choose another, "
        "--preview FILE.png shows it",
        box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z,
        scene::shown_text(scene.camera.name), eye.x, eye.y, eye.z, forward.x, forward.y,
        forward.z));
}

void write_preview(const std::filesystem::path& path,
                   const scene::Scene& scene,
                   const BakeParameters& parameters) {
    if (path.extension() != ".png") {
        throw BakeError(fmt::format("--preview is '{}', expected a name that ends in .png",
                                    scene::shown_text(path.string())));
    }
    const RayCaster caster(scene);
    const PixelReceivers pixels(caster, parameters);
    check_framing(scene, pixels);
    constexpr float kAmbient = 0.2F;
    constexpr float kBackdrop = 0.12F;
    FloatImage image{parameters.width, parameters.height, 3, {}};
    image.values.resize(std::size_t{3} * parameters.width * parameters.height);
    tbb::parallel_for(std::uint32_t{0}, parameters.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < parameters.width; ++x) {
            const PixelView pixel = pixels.view(x, y);
            Imath::V3f shown(kBackdrop * (1 - pixel.coverage));
            for (const ReceiverSurface& surface : pixel.surfaces) {
                const scene::Bsdf& bsdf = surface.point.bsdf;
                const float lit = kAmbient + (1 - kAmbient) * surface.point.wo.z;
                shown +=
                    (bsdf.diffuse_colour() + bsdf.specular_colour()) * (surface.share * lit);
            }
            for (int c = 0; c < 3; ++c) {
                image.values[3 * (std::size_t{y} * parameters.width + x) +
                             static_cast<std::size_t>(c)] = scene::srgb_from_linear(shown[c]);
            }
        }
    });
    write_png(path, image);
}

}  // namespace relume::bake
