#include "precompute/bake/base/measured_brdf.h"

#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_names.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::bake {
namespace {

void require_known(const scene::Scene& scene, const MeasuredBrdf& measured) {
    std::vector<std::string> names;
    for (const scene::Material& material : scene.materials) {
        names.push_back(material.name);
    }
    if (std::find(names.begin(), names.end(), measured.material) == names.end()) {
        throw program::UsageError(
            fmt::format("--measured names the material '{}', expected {}", measured.material,
                        text::expected_name(measured.material, names, "materials")));
    }
}

}  // namespace

MeasuredBrdf read_measured_brdf(std::string_view material_and_file) {
    const std::size_t equals = material_and_file.find('=');
    if (equals == std::string_view::npos || equals == 0 ||
        equals + 1 == material_and_file.size()) {
        throw program::UsageError(
            fmt::format("--measured is '{}', expected MATERIAL=FILE", material_and_file));
    }
    const std::filesystem::path file(material_and_file.substr(equals + 1));
    const std::string bytes = files::read_regular_file(file, factors::MerlBrdf::kFileBytes);
    return {.material = std::string(material_and_file.substr(0, equals)),
            .file = file,
            .content_hash = XXH3_64bits(bytes.data(), bytes.size()),
            .brdf = {file.string(), std::as_bytes(std::span(bytes))}};
}

const MeasuredBrdf* measured_brdf_of(std::span<const MeasuredBrdf> measured,
                                     const std::string& material) {
    const auto found =
        std::find_if(measured.rbegin(), measured.rend(),
                     [&](const MeasuredBrdf& one) { return one.material == material; });
    return found == measured.rend() ? nullptr : &*found;
}

Imath::V3f albedo_of(const factors::MerlBrdf& brdf) {
    // Directions to the light and to the viewer, each spread evenly over the disc below its
    // hemisphere, so that cosines are in them.
    constexpr int kSide = 64;
    Imath::V3d sum(0);
    const auto direction = [](int ring, double phi) {
        const double radius2 = (ring + 0.5) / kSide;
        const double radius = std::sqrt(radius2);
        return Imath::V3f(
            Imath::V3d(radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - radius2)));
    };
    for (int of_light = 0; of_light < kSide; ++of_light) {
        for (int of_viewer = 0; of_viewer < kSide; ++of_viewer) {
            // Isotropic and even: half of all differences of azimuth stand for all.
            for (int turn = 0; turn < kSide; ++turn) {
                sum += Imath::V3d(brdf.evaluate(
                    direction(of_light, 0),
                    direction(of_viewer, std::numbers::pi * (turn + 0.5) / kSide)));
            }
        }
    }
    const Imath::V3d albedo = sum * (std::numbers::pi / (double{kSide} * kSide * kSide));
    return {static_cast<float>(std::min(albedo.x, 1.0)),
            static_cast<float>(std::min(albedo.y, 1.0)),
            static_cast<float>(std::min(albedo.z, 1.0))};
}

scene::Scene scene_with_albedos(const scene::Scene& scene,
                                std::span<const MeasuredBrdf> measured) {
    for (const MeasuredBrdf& one : measured) {
        require_known(scene, one);
    }
    scene::Scene changed = scene;
    for (scene::Material& material : changed.materials) {
        if (const MeasuredBrdf* const brdf = measured_brdf_of(measured, material.name)) {
            // What is no reflection stays: holes, with the texture that cuts them, and the
            // relief of a normal map.
            scene::Material matte{.name = material.name, .base_colour = albedo_of(brdf->brdf)};
            matte.opacity = material.opacity;
            matte.alpha_cutoff = material.alpha_cutoff;
            if (material.has_holes()) {
                matte.base_texture = material.base_texture;
            }
            matte.normal_scale = material.normal_scale;
            matte.normal_texture = material.normal_texture;
            material = std::move(matte);
        }
    }
    return changed;
}

}  // namespace relume::bake
