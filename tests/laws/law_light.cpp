#include "tests/laws/law_light.h"

#include "protocol/basis/cubemap.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace relume::test {
namespace {

using Imath::V3d;

constexpr double kPi = std::numbers::pi;

}  // namespace

V3d sun_and_gradient(const V3d& direction) {
    static const V3d kSun = V3d(-0.5, 0.75, 0.45).normalized();
    static const double kSunCosine = std::cos(3.0 * kPi / 180.0);
    V3d radiance(0.10, 0.09, 0.08);
    if (direction.y > 0) {
        const double t = std::sqrt(direction.y);
        radiance = V3d(1.0, 0.85, 0.7) * (1.0 - t) + V3d(0.25, 0.45, 0.9) * t;
    }
    if (direction.dot(kSun) > kSunCosine)
        radiance += V3d(1.0, 0.92, 0.8) * 220.0;
    return radiance;
}

reference::Sky::Radiance radiance_from_lat_long(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input)
        throw std::runtime_error("cannot open " + path.string() + ": " + OIIO::geterror());
    const int width = input->spec().width;
    const int height = input->spec().height;
    std::vector<float> texels(static_cast<std::size_t>(width) *
                              static_cast<std::size_t>(height) * 3);
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, texels.data()))
        throw std::runtime_error("cannot read " + path.string() + ": " + input->geterror());
    for (float& value : texels)
        value = std::isfinite(value) ? std::max(value, 0.0F) : 0.0F;
    return [=, texels = std::move(texels)](const V3d& direction) {
        // protocol/README.md §1: φ = 2π(x/w − ½), θ = π(½ − y/h).
        const double phi = std::atan2(direction.x, -direction.z);
        const double theta = std::asin(std::clamp(direction.y, -1.0, 1.0));
        const double x = (phi / (2.0 * kPi) + 0.5) * width - 0.5;
        const double y = (0.5 - theta / kPi) * height - 0.5;
        const double column = std::floor(x);
        const double row = std::floor(y);
        const auto texel = [&](int dx, int dy) {
            const int cx = (static_cast<int>(column) + dx + width) % width;
            const int cy = std::clamp(static_cast<int>(row) + dy, 0, height - 1);
            const std::size_t i =
                3 * (static_cast<std::size_t>(cy) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(cx));
            return V3d(texels[i], texels[i + 1], texels[i + 2]);
        };
        const double fx = x - column;
        const double fy = y - row;
        return (texel(0, 0) * (1.0 - fx) + texel(1, 0) * fx) * (1.0 - fy) +
               (texel(0, 1) * (1.0 - fx) + texel(1, 1) * fx) * fy;
    };
}

std::vector<Imath::V3f> cubemap_from_function(std::uint32_t n,
                                              const reference::Sky::Radiance& radiance) {
    constexpr int kProbes = 24;
    std::vector<Imath::V3f> texels;
    for (std::size_t i = 0; i < basis::texel_count(n); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        V3d sum(0, 0, 0);
        double total = 0;
        for (int row = 0; row < kProbes; ++row) {
            for (int column = 0; column < kProbes; ++column) {
                const V3d direction(basis::direction_from_texel(
                    n, texel, (static_cast<float>(column) + 0.5F) / kProbes,
                    (static_cast<float>(row) + 0.5F) / kProbes));
                // On a cube the solid angle falls with the cube of the largest component.
                const double largest = std::max(
                    {std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
                const double weight = largest * largest * largest;
                sum += radiance(direction) * weight;
                total += weight;
            }
        }
        texels.emplace_back(sum / total);
    }
    return texels;
}

}  // namespace relume::test
