#include "tests/lab/measures/reference_file.h"

#include "precompute/bake/fingerprint.h"
#include "precompute/bake/image_file.h"
#include "precompute/scene/camera.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

namespace relume::lab {
namespace {

// Below each other: what pixels contain; then of every light two halves and what is open. Parts
// of one value a pixel are grey.
constexpr std::size_t kPartsPerLight = 3;

std::size_t part_count(std::size_t lights) {
    return 1 + kPartsPerLight * lights;
}

}  // namespace

std::string reference_file_name(const scene::Scene& scene,
                                const std::vector<ReferenceLight>& lights,
                                const ReferenceOptions& options) {
    // Whatever a bake takes by default is no part of a reference.
    bake::BakeParameters parameters{
        .bits = 8, .pixel_samples = 1, .edge_samples = 0, .pool_radius = 0, .shrinkage = 0};
    parameters.width = options.width;
    parameters.height = options.height;
    parameters.face_resolution = options.face_resolution;
    parameters.bounces = options.bounces;
    parameters.samples = options.paths;
    std::string rest = fmt::format("{} {}", options.side, options.edge_side);
    for (const ReferenceLight& light : lights) {
        rest += ' ' + light.name;
        for (const std::vector<float>& plane : light.texels) {
            rest +=
                fmt::format(" {:x}", XXH3_64bits(plane.data(), plane.size() * sizeof(float)));
        }
    }
    const scene::Camera camera(scene.camera, options.width, options.height);
    return fmt::format("{}-{:016x}.exr", scene.name,
                       bake::fingerprint_of(scene, camera, parameters, rest));
}

void write_reference(const std::filesystem::path& path,
                     const BakeReference& reference,
                     const ReferenceOptions& options) {
    const std::size_t parts = part_count(reference.lit.size());
    bake::FloatImage image{.width = options.width,
                           .height = static_cast<std::uint32_t>(options.height * parts),
                           .channels = 3,
                           .values = {}};
    for (const PixelContent content : reference.content) {
        image.values.insert(image.values.end(), 3, static_cast<float>(content));
    }
    for (const LitReference& lit : reference.lit) {
        for (const std::vector<float>& half : lit.half) {
            image.values.insert(image.values.end(), half.begin(), half.end());
        }
        for (const float open : lit.key_open) {
            image.values.insert(image.values.end(), 3, open);
        }
    }
    bake::write_exr(path, image);
}

std::optional<BakeReference> read_reference(const std::filesystem::path& path,
                                            std::size_t lights,
                                            const ReferenceOptions& options) {
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    const std::size_t parts = part_count(lights);
    const auto file = OIIO::ImageInput::open(path.string());
    if (!file || file->spec().width != static_cast<int>(options.width) ||
        file->spec().height != static_cast<int>(options.height * parts) ||
        file->spec().nchannels != 3) {
        return std::nullopt;
    }
    const std::size_t part = std::size_t{3} * options.width * options.height;
    std::vector<float> values(part * parts);
    if (!file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, values.data())) {
        return std::nullopt;
    }
    auto next = values.begin();
    const auto take_rgb = [&] {
        next += static_cast<std::ptrdiff_t>(part);
        return std::vector<float>(next - static_cast<std::ptrdiff_t>(part), next);
    };
    const auto take_grey = [&] {
        std::vector<float> grey;
        for (const auto end = next + static_cast<std::ptrdiff_t>(part); next != end;
             next += 3) {
            grey.push_back(*next);
        }
        return grey;
    };
    BakeReference reference;
    for (const float content : take_grey()) {
        reference.content.push_back(static_cast<PixelContent>(
            std::clamp(content, 0.0F, static_cast<float>(PixelContent::matte))));
    }
    for (std::size_t i = 0; i < lights; ++i) {
        LitReference& lit = reference.lit.emplace_back();
        lit.half[0] = take_rgb();
        lit.half[1] = take_rgb();
        lit.key_open = take_grey();
    }
    return reference;
}

}  // namespace relume::lab
