#include "server/materials/tile_estimate.h"

#include "protocol/basis/cubemap.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/sampling/sobol.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace relume::materials {
namespace {

using sampling::CurveSampler;
using sampling::Way;

// Of a glance.
constexpr std::uint32_t kGlanceSamples = 1;

// One point of the material, ready to be sampled.
struct SampledPoint {
    sampling::CurvePoint place;
    float share = 0;                        // of its pixel
    std::span<const std::uint64_t> sees{};  // bits
    std::size_t pixel = 0;                  // among those of the tile that show the material
    std::uint32_t run = 0;                  // of the pixel in the sequences
    std::uint64_t key = 0;                  // of the point in its pixel
};

sampling::CurvePoint curve_point(const transport::SeenPoint& point,
                                 const std::optional<brdf::Coat>& coat) {
    sampling::CurvePoint place{.shading = brdf::local_frame(point.normal),
                               .geometric_normal = point.geometric_normal,
                               .wo = {},
                               .diffuse = {.colour = point.diffuse, .coat = coat}};
    place.wo = place.shading.local_from_world(point.wo);
    // Stored directions are rounded.
    place.wo.z = std::max(place.wo.z, brdf::kLeastViewCosine);
    place.wo.normalize();
    return place;
}

// The material's points in a tile.
class PointsOfTile {
  public:
    PointsOfTile(const EditablePoints& points, std::size_t material, std::uint32_t tile) {
        points.visibility().read(tile, bits_);
        const std::size_t words = points.visibility().words_per_point();
        const std::span<const transport::SeenPoint> seen = points.points(tile);
        const std::uint32_t tiles_x = points.image().tiles_x();
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const transport::SeenPoint& point = seen[i];
            number_ = i > 0 && seen[i - 1].slot == point.slot ? number_ + 1 : 0;
            if (point.material != material) {
                continue;
            }
            if (slots_.empty() || slots_.back() != point.slot) {
                slots_.push_back(point.slot);
            }
            const std::uint32_t x =
                tile % tiles_x * transport::kTileSide + point.slot % transport::kTileSide;
            const std::uint32_t y =
                tile / tiles_x * transport::kTileSide + point.slot / transport::kTileSide;
            points_.push_back({.place = curve_point(point, points.materials()[material].coat),
                               .share = point.share,
                               .sees = std::span(bits_).subspan(i * words, words),
                               .pixel = slots_.size() - 1,
                               .run = sampling::morton_index(x, y),
                               .key = transport::mix_bits(number_)});
        }
    }

    [[nodiscard]] const std::vector<std::uint8_t>& slots() const { return slots_; }
    [[nodiscard]] std::span<const SampledPoint> points() const { return points_; }

  private:
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint8_t> slots_;
    std::vector<SampledPoint> points_;
    std::uint64_t number_ = 0;
};

// Calls take(sampler) for every direction from which light may reach the point.
template <typename Take>
void for_each_direction(const SampledPoint& point,
                        const sampling::CurveOfBrdf& edited,
                        const sampling::TexelLight& light,
                        std::uint32_t visibility_n,
                        const DirectionPart& part,
                        const Take& take) {
    std::array<std::uint32_t, sampling::kWays.size()> counts{};
    for (std::size_t way = 0; way < counts.size(); ++way) {
        counts[way] = std::max(
            1U, static_cast<std::uint32_t>(std::lround(
                    point.share *
                    static_cast<float>(part.samples * sampling::kDirectionsOfWay[way]))));
    }
    CurveSampler sampler(point.place, edited, light, counts);
    for (const Way way : sampling::kWays) {
        const auto number = static_cast<std::size_t>(way);
        const std::uint32_t first =
            point.run * part.samples * sampling::kDirectionsOfWay[number];
        const std::uint32_t end = counts[number] * (part.part + 1) / part.parts;
        for (std::uint32_t i = counts[number] * part.part / part.parts; i < end; ++i) {
            if (!sampler.draw(way, first + i, point.key + 16 * std::uint64_t{number})) {
                continue;
            }
            const std::size_t texel = basis::index_from_texel(
                visibility_n, basis::texel_from_direction(visibility_n, sampler.direction()));
            if (transport::is_open(point.sees, texel)) {
                take(sampler);
            }
        }
    }
}

// Whether a curve that columns are not made of is edited.
bool others_are_edited(const ShownMaterial& shown, const curve::CurveBrdf& baked) {
    for (std::size_t i = 0; i < baked.curves().size(); ++i) {
        if (i != shown.taken_up && !(shown.brdf.curves()[i] == baked.curves()[i])) {
            return true;
        }
    }
    return false;
}

Imath::V3f times(const sampling::CurveShares& shares, const curve::Curve& curve) {
    Imath::V3f sum{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c) {
        float& of_channel = sum[static_cast<int>(c)];
        for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
            of_channel += shares.samples[c][k] * curve.rgb[c][k];
        }
    }
    return sum;
}

}  // namespace

bool ShownMaterial::has_columns_of(const ShownMaterial& other) const {
    if (material != other.material || taken_up != other.taken_up) {
        return false;
    }
    for (std::size_t i = 0; i < brdf.curves().size(); ++i) {
        if (i != taken_up && !(brdf.curves()[i] == other.brdf.curves()[i])) {
            return false;
        }
    }
    return true;
}

void TileEstimate::add_directions(const ShownMaterial& shown,
                                  std::uint32_t tile,
                                  const DirectionPart& part,
                                  ColumnSum& sum) const {
    const PointsOfTile points(points_, shown.material, tile);
    if (sum.slots.empty()) {
        sum.slots = points.slots();
        sum.values = ColumnValues(points.slots().size());
    }
    ColumnValues& values = sum.values;
    const curve::CurveBrdf& baked = points_.materials()[shown.material].brdf;
    const sampling::CurveOfBrdf edited{.brdf = shown.brdf, .curve = shown.taken_up};
    const bool baked_is_other = others_are_edited(shown, baked);
    sampling::CurveShares shares;
    for (const SampledPoint& point : points.points()) {
        shares = {};
        Imath::V3f of_baked{0, 0, 0};
        for_each_direction(point, edited, light_.texels, points_.visibility().face_resolution(),
                           part, [&](CurveSampler& sampler) {
                               const Imath::V3f radiance =
                                   light_.texels.radiance(sampler.direction());
                               if (sampler.reflects()) {
                                   sampler.add(radiance, shares);
                               }
                               if (baked_is_other) {
                                   const Imath::V3f& wi = sampler.local_direction();
                                   of_baked += radiance * baked.evaluate(wi, point.place.wo) *
                                               (wi.z / sampler.density());
                               }
                           });
        if (!baked_is_other) {
            of_baked = times(shares, baked.curves()[shown.taken_up].curve);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * values.pixels + point.pixel;
            values.diffuse[at] += point.share * shares.diffuse[static_cast<int>(c)];
            values.baked[at] += point.share * of_baked[static_cast<int>(c)];
            for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
                values.column(c, k)[point.pixel] += point.share * shares.samples[c][k];
            }
        }
    }
}

TileChange TileEstimate::glance(const ShownMaterial& shown, std::uint32_t tile) const {
    const PointsOfTile points(points_, shown.material, tile);
    const curve::CurveBrdf& baked = points_.materials()[shown.material].brdf;
    const sampling::CurveOfBrdf edited{.brdf = shown.brdf, .curve = shown.taken_up};
    TileChange change{.slots = points.slots(),
                      .rgb = std::vector<float>(3 * points.slots().size())};
    for (const SampledPoint& point : points.points()) {
        Imath::V3f sum{0, 0, 0};
        for_each_direction(point, edited, light_.texels, points_.visibility().face_resolution(),
                           {.samples = kGlanceSamples}, [&](CurveSampler& sampler) {
                               const Imath::V3f& wi = sampler.local_direction();
                               const float density = sampler.density();
                               const Imath::V3f more =
                                   (shown.brdf.evaluate(wi, point.place.wo) -
                                    baked.evaluate(wi, point.place.wo)) *
                                       wi.z +
                                   (shown.diffuse - Imath::V3f(1)) *
                                       point.place.diffuse.times_cosine(wi.z, point.place.wo.z);
                               sum +=
                                   light_.pyramid.radiance(sampler.direction(), 1 / density) *
                                   more / density;
                           });
        for (std::size_t c = 0; c < 3; ++c) {
            change.rgb[3 * point.pixel + c] += point.share * sum[static_cast<int>(c)];
        }
    }
    return change;
}

}  // namespace relume::materials
