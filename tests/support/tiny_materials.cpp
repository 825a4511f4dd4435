#include "tests/support/tiny_materials.h"

#include "protocol/basis/cubemap.h"
#include "protocol/curve/curve_brdf.h"
#include "protocol/curve/curve_json.h"
#include "protocol/transport/manifest.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <utility>

namespace relume::test {
namespace {

using Imath::V3f;
using transport::SeenPoint;

V3f random_direction(std::mt19937_64& random) {
    std::normal_distribution<float> normal;
    return V3f(normal(random), normal(random), normal(random)).normalized();
}

// A direction at most about so many degrees off another.
V3f near(const V3f& direction, float degrees, std::mt19937_64& random) {
    return (direction + random_direction(random) * (degrees / 57.3F)).normalized();
}

SeenPoint random_point(std::mt19937_64& random) {
    std::uniform_real_distribution<float> uniform(0, 1);
    SeenPoint point;
    point.geometric_normal = random_direction(random);
    point.normal = near(point.geometric_normal, 10, random);
    point.wo = near(point.normal, 50, random);
    if (point.wo.dot(point.geometric_normal) < 0.1F || point.wo.dot(point.normal) < 0.1F) {
        point.wo = point.normal = point.geometric_normal;
    }
    point.diffuse = {uniform(random), uniform(random), uniform(random)};
    return point;
}

void append_random_bits(const SeenPoint& point,
                        std::uint32_t n,
                        std::mt19937_64& random,
                        std::vector<std::uint64_t>& bits) {
    const std::size_t first = bits.size();
    bits.resize(first + transport::words_of_visibility(n), 0);
    for (std::size_t texel = 0; texel < std::size_t{basis::kFaceCount} * n * n; ++texel) {
        const V3f middle =
            basis::direction_from_texel(n, basis::texel_from_index(n, texel), 0.5F, 0.5F);
        if (random() % 3 != 0 && middle.dot(point.geometric_normal) > 0) {
            bits[first + texel / 64] |= std::uint64_t{1} << (texel % 64);
        }
    }
}

}  // namespace

void add_materials(const std::filesystem::path& directory,
                   const transport::VisibilityFieldBuilder& visibility,
                   const transport::SeenPointsBuilder& points,
                   std::vector<transport::EditableRecord> editable) {
    const auto file = directory / "manifest.json";
    transport::Manifest manifest = transport::read_manifest(file);
    manifest.materials = transport::MaterialsSection{
        .visibility = {.face_resolution = visibility.face_resolution(),
                       .file = visibility.write(directory)},
        .points = points.write(directory),
        .editable = std::move(editable)};
    std::ofstream(file, std::ios::binary) << transport::text_from_manifest(manifest);
}

std::vector<transport::EditableRecord> tiny_editable_materials() {
    const auto metal = curve::CurveBrdf::ggx({0.9F, 0.7F, 0.3F}, 1, 0.3F);
    const auto coat = curve::CurveBrdf::ggx({0.04F, 0.04F, 0.04F}, 1, 0.5F);
    return {{.id = "metal",
             .name = "Metal",
             .brdf = curve::json_from_curve_brdf(metal),
             .coat = {}},
            {.id = "cloth",
             .name = "Cloth",
             .brdf = curve::json_from_curve_brdf(coat),
             .coat = transport::CoatRecord{.f0 = 0.04F, .f90 = 1}}};
}

void add_random_materials(const std::filesystem::path& directory,
                          std::uint32_t face_resolution,
                          std::uint64_t seed) {
    const auto image = transport::read_manifest(directory / "manifest.json").image();
    transport::VisibilityFieldBuilder visibility(face_resolution, image.block_count());
    transport::SeenPointsBuilder points(image.block_count());
    std::mt19937_64 random(seed);
    for (std::uint32_t tile = 0; tile < image.block_count(); ++tile) {
        std::vector<SeenPoint> of_tile;
        std::vector<std::uint64_t> bits;
        const auto add = [&](std::uint32_t slot, std::uint8_t material, float share) {
            SeenPoint point = random_point(random);
            point.slot = static_cast<std::uint8_t>(slot);
            point.material = material;
            point.share = share;
            if (material == 0) {
                point.diffuse = V3f(0, 0, 0);
            }
            append_random_bits(point, face_resolution, random, bits);
            of_tile.push_back(point);
        };
        const std::uint32_t left = tile % image.tiles_x() * transport::kTileSide;
        const std::uint32_t top = tile / image.tiles_x() * transport::kTileSide;
        const std::uint32_t columns = std::min(transport::kTileSide, image.width - left);
        const std::uint32_t rows = std::min(transport::kTileSide, image.height - top);
        for (std::uint32_t y = 0; y < rows; ++y) {
            for (std::uint32_t x = y % 2; x < columns; x += 2) {
                const std::uint32_t slot = transport::kTileSide * y + x;
                if (random() % 2 == 0) {
                    add(slot, static_cast<std::uint8_t>(random() % 2), 1);
                } else {
                    add(slot, 0, 0.25F);
                    add(slot, 1, 0.5F);
                }
            }
        }
        points.set_block(tile, of_tile);
        visibility.set_block(tile, bits);
    }
    add_materials(directory, visibility, points, tiny_editable_materials());
}

}  // namespace relume::test
