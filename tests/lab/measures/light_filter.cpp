#include "tests/lab/measures/light_filter.h"

#include "protocol/basis/cubemap.h"
#include "protocol/light/rotation_resample.h"
#include "tests/lab/measures/turned_map.h"
#include "tests/support/reference_tracer/tracer.h"

#include <Imath/ImathQuat.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace relume::lab {
namespace {

using Imath::V3d;
using Imath::V3f;
using Image = std::vector<V3d>;

TexelLight texels_of(const TexelLightSource& source, const TurnedMap& map) {
    const std::uint32_t n = source.n;
    if (!source.environment) {
        return map.texel_means(n);
    }
    light::LightCubemap cubemap(n);
    light::resample(*source.environment, map.rotation(), V3f(1), light::Write::overwrite,
                    cubemap);
    const auto planes = cubemap.planes();
    TexelLight texels{n, std::vector<V3f>(cubemap.plane_size())};
    for (std::size_t i = 0; i < texels.radiance.size(); ++i) {
        texels.radiance[i] = {planes[0][i], planes[1][i], planes[2][i]};
    }
    return texels;
}

Imath::Quatf turn_about_vertical(double radians) {
    Imath::Quatf rotation;
    rotation.setAxisAngle(V3f(0, 1, 0), static_cast<float>(radians));
    return rotation;
}

// A turned map and every texel light that stands for it.
struct Lights {
    TurnedMap map;
    std::vector<TexelLight> texels;
};

Lights lights_after(const Imath::Quatf& rotation,
                    const light::EnvironmentMap& map,
                    std::span<const TexelLightSource> sources) {
    Lights lights{TurnedMap(map, rotation), {}};
    for (const TexelLightSource& source : sources) {
        lights.texels.push_back(texels_of(source, lights.map));
    }
    return lights;
}

// Paths that look where the lights differ from the map.
reference::Sky guide_to(std::span<const Lights> turns) {
    const std::uint32_t n = TurnedMap::kMeansResolution;
    std::vector<V3f> sum(basis::texel_count(n), V3f(0));
    for (const Lights& lights : turns) {
        const TexelLight means = lights.map.texel_means(n);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const V3f direction = basis::direction_from_texel(n, basis::texel_from_index(n, i));
            // Texels in which the map varies look alike here and are not.
            constexpr float kPart = 0.1F;
            sum[i] += kPart * means.radiance[i];
            for (const TexelLight& light : lights.texels) {
                const V3f off = light.towards(direction) - means.radiance[i];
                sum[i] += {std::abs(off.x), std::abs(off.y), std::abs(off.z)};
            }
        }
    }
    return reference::Sky::from_cubemap(n, sum);
}

// By turn: the image under the map, and those under its texel lights.
using Images = std::vector<std::vector<Image>>;

Images images_under(const scene::Scene& scene,
                    std::span<const Lights> turns,
                    const reference::Sky& guide,
                    const LightFilterOptions& options,
                    std::uint64_t seed) {
    const std::size_t pixels = std::size_t{options.image_side} * options.image_side;
    Images images(turns.size());
    for (std::size_t turn = 0; turn < turns.size(); ++turn) {
        images[turn].assign(1 + turns[turn].texels.size(), Image(pixels, V3d(0)));
    }
    reference::trace_arrivals(scene, guide,
                              {.width = options.image_side,
                               .height = options.image_side,
                               .samples = options.samples,
                               .bounces = options.bounces,
                               .seed = seed},
                              [&](std::size_t pixel, const V3d& direction, const V3d& weight) {
                                  const V3f towards(direction);
                                  for (std::size_t turn = 0; turn < turns.size(); ++turn) {
                                      const Lights& lights = turns[turn];
                                      images[turn][0][pixel] +=
                                          weight * V3d(lights.map.towards(towards));
                                      for (std::size_t i = 0; i < lights.texels.size(); ++i) {
                                          images[turn][1 + i][pixel] +=
                                              weight * V3d(lights.texels[i].towards(towards));
                                      }
                                  }
                              });
    return images;
}

// Σ over pixels and colours of the product of two images.
double product(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i].dot(b[i]);
    }
    return sum;
}

Image difference(const Image& a, const Image& b) {
    Image result(a.size());
    std::transform(a.begin(), a.end(), b.begin(), result.begin(),
                   [](const V3d& x, const V3d& y) { return x - y; });
    return result;
}

// Collects pairs of independent images of one thing, whose squared norm it is to find.
class SquareMeter {
  public:
    void add(const Image& first, const Image& second) {
        squared_ += product(first, second);
        // The product of two noises of variance s² at N values has the deviation s²·√N.
        const Image noise = difference(first, second);
        const double variance_sum = product(noise, noise) / 2;
        variance_of_squared_ +=
            variance_sum * variance_sum / (3.0 * static_cast<double>(noise.size()));
    }
    [[nodiscard]] Measured relative_to(double size) const {
        return {.value = std::sqrt(std::max(0.0, squared_) / size),
                .least = std::sqrt(std::sqrt(variance_of_squared_) / size)};
    }

  private:
    double squared_ = 0;
    double variance_of_squared_ = 0;
};

double energy_of(const TexelLight& light) {
    double sum = 0;
    for (std::size_t i = 0; i < light.radiance.size(); ++i) {
        const basis::Texel texel = basis::texel_from_index(light.n, i);
        const V3f& radiance = light.radiance[i];
        sum += basis::solid_angle_sr(light.n, texel.row, texel.column) *
               double{radiance.x + radiance.y + radiance.z};
    }
    return sum;
}

}  // namespace

std::vector<Measured> light_filter_distances(const scene::Scene& scene,
                                             const light::EnvironmentMap& map,
                                             std::span<const TexelLightSource> sources,
                                             const LightFilterOptions& options) {
    std::mt19937_64 random(options.seed);
    const double start = std::uniform_real_distribution<double>(0, 1)(random);
    double size = 0;
    std::vector<SquareMeter> meters(sources.size());
    for (std::uint32_t turn = 0; turn < options.turns; ++turn) {
        const double radians = 2 * std::numbers::pi * (turn + start) / options.turns;
        std::vector<Lights> turns;
        turns.push_back(lights_after(turn_about_vertical(radians), map, sources));
        const reference::Sky guide = guide_to(turns);
        const auto first = images_under(scene, turns, guide, options, random()).front();
        const auto second = images_under(scene, turns, guide, options, random()).front();
        size += product(first[0], second[0]);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            meters[i].add(difference(first[1 + i], first[0]),
                          difference(second[1 + i], second[0]));
        }
    }
    std::vector<Measured> distances;
    for (const SquareMeter& meter : meters) {
        distances.push_back(meter.relative_to(size));
    }
    return distances;
}

std::vector<LightWalk> light_walks(const scene::Scene& scene,
                                   const light::EnvironmentMap& map,
                                   std::span<const TexelLightSource> sources,
                                   const LightFilterOptions& options) {
    constexpr std::uint32_t kSteps = 10;
    std::mt19937_64 random(options.seed);
    const double texel = 2.0 / sources.front().n;
    std::vector<Lights> turns;
    for (std::uint32_t step = 0; step <= kSteps; ++step) {
        turns.push_back(lights_after(turn_about_vertical(texel * step / kSteps), map, sources));
    }
    const reference::Sky guide = guide_to(turns);
    const Images first = images_under(scene, turns, guide, options, random());
    const Images second = images_under(scene, turns, guide, options, random());
    double size = 0;
    std::vector<SquareMeter> meters(sources.size());
    for (std::uint32_t step = 1; step <= kSteps; ++step) {
        const auto change = [step](const Images& images, std::size_t light) {
            return difference(images[step][light], images[step - 1][light]);
        };
        size += product(change(first, 0), change(second, 0));
        for (std::size_t i = 0; i < sources.size(); ++i) {
            meters[i].add(difference(change(first, 1 + i), change(first, 0)),
                          difference(change(second, 1 + i), change(second, 0)));
        }
    }
    std::vector<LightWalk> walks;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        std::vector<double> energies;
        for (const Lights& lights : turns) {
            energies.push_back(energy_of(lights.texels[i]));
        }
        const auto [least, most] = std::minmax_element(energies.begin(), energies.end());
        walks.push_back(
            {.flicker = meters[i].relative_to(size), .energy_range = *most / *least - 1});
    }
    return walks;
}

}  // namespace relume::lab
