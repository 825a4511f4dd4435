#include "tests/lab/measures/scene_noise.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/relight.h"
#include "protocol/basis/haar.h"
#include "protocol/light/rotation_resample.h"
#include "protocol/transport/transport.h"
#include "tests/lab/sequences/environment_source.h"

#include <Imath/ImathQuat.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace relume::lab {
namespace {

// Colourless, of Haar coefficients.
ReferenceLight grey_light(std::string name,
                          std::vector<float> coefficients,
                          std::uint32_t face_resolution) {
    basis::haar_inverse_cubemap(face_resolution, coefficients);
    ReferenceLight light{.name = std::move(name), .texels = {}};
    light.texels.fill(coefficients);
    return light;
}

std::vector<float> interleaved(const bake::DenseImage& image) {
    std::vector<float> rgb;
    rgb.reserve(3 * image.rgb[0].size());
    for (std::size_t i = 0; i < image.rgb[0].size(); ++i) {
        for (const std::vector<double>& plane : image.rgb) {
            rgb.push_back(static_cast<float>(plane[i]));
        }
    }
    return rgb;
}

}  // namespace

std::vector<ReferenceLight> environment_lights(const std::vector<std::string>& names,
                                               double yaw_degrees,
                                               std::uint32_t face_resolution) {
    const double half_angle = yaw_degrees / 360 * std::numbers::pi;
    const Imath::Quatf rotation(static_cast<float>(std::cos(half_angle)), 0,
                                static_cast<float>(std::sin(half_angle)), 0);
    std::vector<ReferenceLight> lights;
    for (const std::string& name : names) {
        light::LightCubemap cubemap(face_resolution);
        light::resample(*load_environment(name, face_resolution), rotation, Imath::V3f(1),
                        light::Write::overwrite, cubemap);
        ReferenceLight light{.name = name, .texels = {}};
        const auto planes = std::as_const(cubemap).planes();
        for (std::size_t c = 0; c < planes.size(); ++c) {
            light.texels[c].assign(planes[c].begin(), planes[c].end());
        }
        lights.push_back(std::move(light));
    }
    return lights;
}

std::vector<ReferenceLight> model_lights(std::uint32_t face_resolution) {
    const auto projection =
        basis::CubemapProjection::onto(basis::CubemapBasis::haar(face_resolution));
    std::vector<ReferenceLight> lights;
    for (std::size_t i = 0; i < kModelLights; ++i) {
        lights.push_back(grey_light(fmt::format("natural-{}", i),
                                    bake::natural_light(projection->basis(), i),
                                    face_resolution));
    }
    for (std::size_t i = 0; i < kModelLights; ++i) {
        lights.push_back(grey_light(fmt::format("sun-{}", i), bake::sun_light(*projection, i),
                                    face_resolution));
    }
    return lights;
}

double SceneNoise::relative_l2(std::size_t first, std::size_t count) const {
    KindNoise total;
    for (std::size_t i = first; i < first + count; ++i) {
        for (const KindNoise& kind : lit[i]) {
            total.add(kind);
        }
    }
    return total.relative_rmse();
}

SceneNoise measure_noise(const scene::Scene& scene,
                         const std::vector<ReferenceLight>& lights,
                         const BakeReference& reference,
                         bake::BakeParameters parameters,
                         std::uint32_t seeds,
                         const std::filesystem::path& directory) {
    SceneNoise noise;
    noise.lit.resize(lights.size());
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        parameters.seed = seed;
        std::filesystem::remove_all(directory);
        const bake::BakeSummary summary = bake::bake(scene, parameters, directory);
        const auto transport = transport::Transport::open(directory);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            std::vector<float> picture =
                interleaved(bake::relight(*transport, lights[i].texels));
            const BakeNoise one = bake_noise(picture, reference, i);
            for (std::size_t kind = 0; kind < one.size(); ++kind) {
                noise.lit[i][kind].add(one[kind]);
            }
            if (seed == 1) {
                noise.pictures.push_back(std::move(picture));
            }
        }
        const auto stated = transport->manifest().sampling_error.value();
        noise.stated_natural += stated.natural * stated.natural / seeds;
        noise.stated_sun += stated.sun * stated.sun / seeds;
        noise.visibility_rays += static_cast<double>(summary.visibility_rays) / seeds;
        noise.path_rays += static_cast<double>(summary.path_rays) / seeds;
        noise.cpu_seconds += summary.cpu_seconds / seeds;
    }
    std::filesystem::remove_all(directory);
    noise.stated_natural = std::sqrt(noise.stated_natural);
    noise.stated_sun = std::sqrt(noise.stated_sun);
    return noise;
}

}  // namespace relume::lab
