#include "tests/support/dense_product.h"

#include "protocol/basis/cubemap_projection.h"
#include "tests/support/tiny_transport.h"

#include <cstddef>
#include <span>
#include <stdexcept>

namespace relume::test {

LinearImage dense_product(const transport::Transport& transport,
                          const std::vector<Imath::V3f>& light) {
    const transport::Manifest& manifest = transport.manifest();
    const auto projection = basis::CubemapProjection::onto(manifest.signal_basis.cubemap());
    if (light.size() != basis::texel_count(manifest.signal_basis.cubemap().face_resolution()))
        throw std::invalid_argument("the light has other texels than the transport");
    const std::size_t columns = transport.column_count();
    std::vector<float> plane(light.size());
    std::vector<float> coefficients(3 * columns);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < light.size(); ++i)
            plane[i] = light[i][static_cast<int>(c)];
        projection->project_radiance(plane,
                                     std::span(coefficients).subspan(c * columns, columns));
    }
    std::vector<double> sums = dense_product(transport, coefficients);
    receivers_from_sums(sums);

    const std::uint32_t width = manifest.image().width;
    const std::uint32_t height = manifest.image().height;
    LinearImage image{width, height, {}};
    constexpr std::size_t kBlock = transport::kBlockSize;
    const std::uint32_t tiles_x = (width + 15) / 16;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t block = std::size_t{y / 16} * tiles_x + x / 16;
            const std::size_t slot = std::size_t{y % 16} * 16 + x % 16;
            Imath::V3d pixel;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = (block * 3 + c) * kBlock + slot;
                pixel[static_cast<int>(c)] = sums[at] * double{transport.tint()[at]};
            }
            image.pixels.push_back(pixel);
        }
    }
    return image;
}

}  // namespace relume::test
