#include "precompute/bake/relight.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/mesh/surface_image.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/cubemap_projection.h"
#include "protocol/basis/curve_projection.h"
#include "protocol/transport/block_basis.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

namespace relume::bake {
namespace {

using transport::kBlockSize;

// Adds the columns of one shard to `pixels`, [blocks][3][256].
void add_shard(const transport::Transport& transport,
               const transport::ShardReader& shard,
               const SignalCoefficients& coefficients,
               std::vector<double>& pixels) {
    const transport::ColourModel& colour = transport.manifest().colour;
    transport::DecodedCell values;
    for (std::size_t j = 0; j < transport.column_count(); ++j) {
        for (std::uint32_t k = 0; k < colour.channels; ++k) {
            const transport::SegmentView segment = shard.segment(j, k);
            if (segment.empty()) {
                continue;
            }
            std::array<double, 3> factor{};
            for (std::size_t c = 0; c < 3; ++c) {
                factor[c] =
                    double{coefficients.rgb[c][j]} * colour.matrix[c][k] * transport.step(j, k);
            }
            const std::uint8_t* cell = segment.cells;
            for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
                const transport::CellTag tag = segment.tag(block);
                if (tag == transport::CellTag::empty) {
                    continue;
                }
                cell = transport::decode_cell(tag, cell, values);
                for (std::size_t c = 0; c < 3; ++c) {
                    double* target =
                        &pixels[((shard.first_block() + block) * 3 + c) * kBlockSize];
                    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                        target[slot] += factor[c] * values[slot];
                    }
                }
            }
        }
    }
}

// From each block's basis to its receivers.
void to_receivers(transport::BlockBasis basis, std::vector<double>& sums) {
    std::array<float, kBlockSize> block;
    for (std::size_t first = 0; first < sums.size(); first += kBlockSize) {
        const auto values = std::span(sums).subspan(first, kBlockSize);
        std::transform(values.begin(), values.end(), block.begin(),
                       [](double value) { return static_cast<float>(value); });
        transport::block_receivers_from_coefficients(basis, block);
        std::copy(block.begin(), block.end(), values.begin());
    }
}

DenseImage empty_image(const transport::TileGrid& size) {
    DenseImage image{.width = size.width, .height = size.height, .rgb = {}, .coverage = {}};
    const std::size_t pixels = std::size_t{size.width} * size.height;
    for (auto& plane : image.rgb) {
        plane.resize(pixels);
    }
    image.coverage.resize(pixels);
    return image;
}

DenseImage image_of_tiles(const transport::Transport& transport,
                          std::span<const double> values) {
    const transport::TileGrid& size = transport.manifest().image();
    DenseImage image = empty_image(size);
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const transport::ReceiverPlace at = size.place_from_pixel(x, y);
            const std::size_t pixel = std::size_t{y} * size.width + x;
            for (std::size_t c = 0; c < 3; ++c) {
                image.rgb[c][pixel] =
                    values[(std::size_t{at.block} * 3 + c) * kBlockSize + at.slot];
            }
            image.coverage[pixel] =
                transport.coverage()[std::size_t{at.block} * kBlockSize + at.slot];
        }
    }
    return image;
}

DenseImage image_of_surface(const transport::Transport& transport,
                            std::span<const double> values) {
    constexpr std::uint32_t kRaysAlongPixel = 4;
    const transport::Manifest& manifest = transport.manifest();
    const SurfaceImage seen =
        view_surface(transport, values, manifest.camera, manifest.mesh->view, kRaysAlongPixel);
    DenseImage image = empty_image(seen.size);
    for (std::size_t pixel = 0; pixel < seen.rgb.size(); ++pixel) {
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgb[c][pixel] = seen.rgb[pixel][static_cast<int>(c)];
        }
        image.coverage[pixel] = seen.coverage[pixel];
    }
    return image;
}

}  // namespace

SignalCoefficients coefficients_of_light(const transport::Transport& transport,
                                         const CubemapLight& light) {
    const basis::SignalBasis& basis = transport.manifest().signal_basis;
    if (!basis.is_of_light()) {
        throw BakeError(
            "the transport is of kind curves, whose light is frozen, expected one of light");
    }
    const auto projection = basis::CubemapProjection::onto(basis.cubemap());
    const std::size_t texels = basis::texel_count(basis.cubemap().face_resolution());
    SignalCoefficients coefficients;
    for (std::size_t c = 0; c < light.size(); ++c) {
        if (light[c].size() != texels) {
            throw BakeError(
                fmt::format("the light has {} texels, expected {}", light[c].size(), texels));
        }
        coefficients.rgb[c].resize(transport.column_count());
        projection->project_radiance(light[c], coefficients.rgb[c]);
    }
    return coefficients;
}

SignalCoefficients coefficients_as_baked(const transport::Transport& transport) {
    const transport::Manifest& manifest = transport.manifest();
    if (!manifest.curves) {
        throw BakeError(fmt::format("the transport is of kind {}, expected curves",
                                    transport::kKindNames.name(manifest.kind)));
    }
    SignalCoefficients coefficients;
    for (std::size_t c = 0; c < coefficients.rgb.size(); ++c) {
        std::vector<float>& plane = coefficients.rgb[c];
        plane.assign(transport.column_count(), 0.0F);
        basis::project_rest(plane);
        for (std::uint32_t m = 0; m < manifest.curves->curves.size(); ++m) {
            basis::project_curve(manifest.signal_basis.curves(), m, 1,
                                 manifest.curves->curves[m].baked[c], plane);
        }
    }
    return coefficients;
}

std::vector<double> relit_receivers(const transport::Transport& transport,
                                    const SignalCoefficients& signal) {
    const transport::Manifest& manifest = transport.manifest();
    std::vector<double> values(std::size_t{manifest.block_count()} * 3 * kBlockSize);
    tbb::parallel_for(std::size_t{0}, transport.shards().size(), [&](std::size_t i) {
        add_shard(transport, transport.shards()[i], signal, values);
    });
    to_receivers(manifest.block_basis, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] *= double{transport.tint()[i]};
    }
    return values;
}

std::vector<double> relit_receivers(const transport::Transport& transport,
                                    const CubemapLight& light) {
    return relit_receivers(transport, coefficients_of_light(transport, light));
}

DenseImage relight(const transport::Transport& transport, const SignalCoefficients& signal) {
    const std::vector<double> values = relit_receivers(transport, signal);
    return transport.manifest().kind == transport::Kind::mesh
               ? image_of_surface(transport, values)
               : image_of_tiles(transport, values);
}

DenseImage relight(const transport::Transport& transport, const CubemapLight& light) {
    return relight(transport, coefficients_of_light(transport, light));
}

CubemapLight read_cubemap_strip(const std::filesystem::path& path,
                                std::uint32_t face_resolution) {
    files::require_regular_file(path);
    const auto file = OIIO::ImageInput::open(path.string());
    if (!file) {
        throw BakeError(fmt::format("{}: {}", path.string(), OIIO::geterror()));
    }
    const OIIO::ImageSpec& spec = file->spec();
    const auto n = static_cast<int>(face_resolution);
    const bool across = spec.width == 6 * n && spec.height == n;
    const bool down = spec.width == n && spec.height == 6 * n;
    if (!across && !down) {
        throw BakeError(fmt::format("{}: {}×{} pixels, expected a cubemap strip of {}×{}",
                                    path.string(), spec.width, spec.height, 6 * n, n));
    }
    if (spec.nchannels < 3) {
        throw BakeError(
            fmt::format("{}: {} channels, expected R, G, B", path.string(), spec.nchannels));
    }
    const std::size_t count = basis::texel_count(face_resolution);
    std::vector<float> rgb(count * 3);
    if (!file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, rgb.data())) {
        throw BakeError(fmt::format("{}: {}", path.string(), file->geterror()));
    }
    CubemapLight light;
    for (std::size_t c = 0; c < 3; ++c) {
        light[c].resize(count);
        for (std::size_t texel = 0; texel < count; ++texel) {
            const basis::Texel at = basis::texel_from_index(face_resolution, texel);
            const auto face = static_cast<std::size_t>(at.face);
            const std::size_t pixel =
                across ? (at.row * std::size_t{6} + face) * face_resolution + at.column : texel;
            light[c][texel] = rgb[pixel * 3 + c];
            if (!std::isfinite(light[c][texel])) {
                throw BakeError(
                    fmt::format("{}: texel {} of face {} is not finite, expected radiance",
                                path.string(), texel, face));
            }
        }
    }
    return light;
}

}  // namespace relume::bake
