#include "tests/support/dense_product.h"

#include "protocol/basis/cubemap_projection.h"
#include "protocol/transport/cell.h"
#include "tests/support/tiny_transport.h"

#include <cstddef>
#include <stdexcept>

namespace relume::test {

LinearImage dense_product(const transport::Transport& transport,
                          const std::vector<Imath::V3f>& light) {
    const transport::Manifest& manifest = transport.manifest();
    const auto projection = basis::CubemapProjection::onto(manifest.signal_basis);
    if (light.size() != basis::texel_count(manifest.signal_basis.face_resolution()))
        throw std::invalid_argument("the light has other texels than the transport");
    std::vector<float> plane(light.size());
    std::vector<std::vector<float>> coefficients(3,
                                                 std::vector<float>(transport.column_count()));
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < light.size(); ++i)
            plane[i] = light[i][static_cast<int>(c)];
        projection->project_radiance(plane, coefficients[c]);
    }

    constexpr std::size_t kBlock = transport::kBlockSize;
    std::vector<Imath::V3d> receivers(manifest.block_count() * kBlock, Imath::V3d(0, 0, 0));
    transport::DecodedCell q;
    for (const transport::ShardReader& shard : transport.shards()) {
        for (std::size_t j = 0; j < transport.column_count(); ++j) {
            for (std::uint32_t k = 0; k < transport.channel_count(); ++k) {
                const transport::SegmentView segment = shard.segment(j, k);
                if (segment.empty())
                    continue;
                Imath::V3d factor;
                for (std::size_t c = 0; c < 3; ++c)
                    factor[static_cast<int>(c)] = double{manifest.colour.matrix[c][k]} *
                                                  transport.step(j, k) * coefficients[c][j];
                const std::uint8_t* cell = segment.cells;
                for (std::uint32_t b = 0; b < shard.block_count(); ++b) {
                    if (segment.tag(b) == transport::CellTag::empty)
                        continue;
                    cell = transport::decode_cell(segment.tag(b), cell, q);
                    for (std::size_t slot = 0; slot < kBlock; ++slot)
                        receivers[(shard.first_block() + b) * kBlock + slot] +=
                            factor * double{q[slot]};
                }
            }
        }
    }

    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> sums;
        for (const Imath::V3d& receiver : receivers)
            sums.push_back(receiver[static_cast<int>(c)]);
        receivers_from_sums(sums);
        for (std::size_t p = 0; p < receivers.size(); ++p)
            receivers[p][static_cast<int>(c)] = sums[p];
    }

    const std::uint32_t width = manifest.image().width;
    const std::uint32_t height = manifest.image().height;
    LinearImage image{width, height, {}};
    const std::uint32_t tiles_x = (width + 15) / 16;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t block = std::size_t{y / 16} * tiles_x + x / 16;
            const std::size_t slot = std::size_t{y % 16} * 16 + x % 16;
            Imath::V3d pixel = receivers[block * kBlock + slot];
            for (std::size_t c = 0; c < 3; ++c)
                pixel[static_cast<int>(c)] *=
                    double{transport.tint()[(block * 3 + c) * kBlock + slot]};
            image.pixels.push_back(pixel);
        }
    }
    return image;
}

}  // namespace relume::test
