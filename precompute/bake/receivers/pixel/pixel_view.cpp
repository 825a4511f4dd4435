#include "precompute/bake/receivers/pixel/pixel_view.h"

#include "precompute/scene/mirror_lobe.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace relume::bake {
namespace {

// How much two points of one surface may differ within a pixel.
constexpr float kSameSurfaceCosine = 0.85F;
constexpr float kSameSurfaceFootprints = 2.0F;

struct Gathered {
    ReceiverSurface surface;
    float best_distance = 0;  // of the point that stands for it, from the pixel's centre
    std::vector<scene::SurfacePoint> hits;
};

Imath::V3f colour_of(const scene::SurfacePoint& point) {
    return point.bsdf.diffuse_colour() + point.bsdf.specular_colour();
}

bool same_surface(const ReceiverSurface& a, const ReceiverSurface& b) {
    const Imath::V3f between = b.point.position - a.point.position;
    return a.material == b.material &&
           a.point.shading.normal.dot(b.point.shading.normal) > kSameSurfaceCosine &&
           std::abs(between.dot(a.point.geometric_normal)) <
               kSameSurfaceFootprints * std::max(a.footprint, b.footprint);
}

// Sixteen of the hits, each several times where they are fewer. Of hits on a grid of 4×4, row
// by row, every run of four has one in each row and each column.
const scene::SurfacePoint& hit_of_lane(std::span<const scene::SurfacePoint> hits,
                                       std::uint32_t lane) {
    constexpr std::array<std::uint32_t, kPacketSize> kOrder{1, 14, 7, 8, 2, 13, 4, 11,
                                                            0, 15, 6, 9, 3, 12, 5, 10};
    return hits[(2 * kOrder[lane] + 1) * hits.size() / (2 * kPacketSize)];
}

// Whether some of the hits reflect otherwise than the point: by normal, or for glossy surfaces
// by where the lobe points.
bool turns_far(const scene::SurfacePoint& point, std::span<const scene::SurfacePoint> hits) {
    constexpr float kNormal = 0.15F;  // radians
    constexpr float kOfLobe = 0.5F;
    if (point.bsdf.is_diffuse()) {
        return std::any_of(hits.begin(), hits.end(), [&](const scene::SurfacePoint& hit) {
            return (hit.shading.normal - point.shading.normal).length() > kNormal;
        });
    }
    const Imath::V3f mirror = scene::mirror_direction(point);
    const float far = kOfLobe * scene::lobe_width(point);
    return std::any_of(hits.begin(), hits.end(), [&](const scene::SurfacePoint& hit) {
        return (scene::mirror_direction(hit) - mirror).length() > far;
    });
}

void spread_over_hits(Gathered& one) {
    ReceiverSurface& surface = one.surface;
    std::span<const scene::SurfacePoint> hits = one.hits;
    if (one.best_distance == 0 && hits.size() > 1) {
        hits = hits.subspan(1);  // the middle of the pixel, which is no part of the grid
    }
    for (std::uint32_t lane = 0; lane < kPacketSize; ++lane) {
        surface.origins[lane] = offset_origin(hit_of_lane(hits, lane));
    }
    // What a third of the pixel shows is worth as many as all of it: where surfaces meet, one
    // normal stands for a whole tube.
    constexpr float kTurnsOfPixel = 32;
    const std::uint32_t turns =
        std::min(static_cast<std::uint32_t>(std::ceil(kTurnsOfPixel * surface.share)),
                 static_cast<std::uint32_t>(kPacketSize));
    if (turns < 2 || !turns_far(surface.point, hits)) {
        return;
    }
    for (std::uint32_t lane = 0; lane < turns; ++lane) {
        surface.turns.push_back(hit_of_lane(hits, lane));
        surface.turns.back().bsdf = surface.point.bsdf;
    }
}

// A texture is averaged by its colours, diffuse and specular apart: what a varnish reflects
// does not depend on the wood below it.
void take_mean_colours(Gathered& one) {
    std::vector<scene::Bsdf> places;
    for (const scene::SurfacePoint& hit : one.hits) {
        places.push_back(hit.bsdf);
    }
    one.surface.point.bsdf = one.surface.point.bsdf.with_mean_colours(places);
}

class PixelGatherer {
  public:
    PixelGatherer(const RayCaster& caster, const scene::Camera& camera)
        : caster_(caster), camera_(camera) {}

    void cast(float x, float y, float centre_distance) {
        ++casts_;
        const std::optional<Seen> seen = look(x, y);
        if (!seen) {
            return;
        }
        depth_sum_ += seen->depth;
        albedo_sum_ += colour_of(seen->surface.point);
        ++hits_;
        gather(seen->surface, centre_distance);
    }

    // Whether what was cast so far met more than one smooth surface, or a surface and the sky.
    [[nodiscard]] bool meets_edge() const {
        return gathered_.size() > 1 || (hits_ > 0 && hits_ < casts_);
    }
    // Whether a ray would meet something else than those before it, which meet no edge.
    [[nodiscard]] bool differs(float x, float y) const {
        const std::optional<Seen> seen = look(x, y);
        return gathered_.empty()
                   ? seen.has_value()
                   : !seen || !same_surface(gathered_.front().surface, seen->surface);
    }

    [[nodiscard]] PixelView view() && {
        PixelView view;
        if (hits_ == 0) {
            return view;
        }
        const auto casts = static_cast<float>(casts_);
        view.coverage = static_cast<float>(hits_) / casts;
        view.depth = depth_sum_ / static_cast<float>(hits_);
        view.albedo = albedo_sum_ / casts;
        for (Gathered& one : gathered_) {
            one.surface.share = static_cast<float>(one.hits.size()) / casts;
            take_mean_colours(one);
            spread_over_hits(one);
            one.surface.number = static_cast<std::uint32_t>(view.surfaces.size());
            view.surfaces.push_back(std::move(one.surface));
        }
        return view;
    }

  private:
    struct Seen {
        ReceiverSurface surface;
        float depth = 0;  // along the view axis
    };

    [[nodiscard]] std::optional<Seen> look(float x, float y) const {
        const Imath::V3f direction = camera_.direction_from_pixel(x, y);
        const auto hit = caster_.closest_hit(camera_.eye(), direction);
        if (!hit) {
            return std::nullopt;
        }
        Seen seen;
        seen.surface.point = scene::surface_point(caster_.scene(), hit->mesh, hit->triangle,
                                                  hit->barycentric, direction);
        seen.surface.material = caster_.scene().meshes[hit->mesh].material;
        seen.surface.footprint = hit->distance * 2 * camera_.tan_half_height() /
                                 static_cast<float>(camera_.height());
        seen.depth = hit->distance * direction.dot(camera_.forward());
        return seen;
    }

    void gather(const ReceiverSurface& surface, float centre_distance) {
        auto found = std::find_if(gathered_.begin(), gathered_.end(), [&](const Gathered& one) {
            return same_surface(one.surface, surface);
        });
        if (found == gathered_.end()) {
            gathered_.push_back(
                {.surface = surface, .best_distance = centre_distance, .hits = {}});
            found = gathered_.end() - 1;
        } else if (centre_distance < found->best_distance) {
            found->surface = surface;
            found->best_distance = centre_distance;
        }
        found->hits.push_back(surface.point);
    }

    const RayCaster& caster_;
    const scene::Camera& camera_;
    std::vector<Gathered> gathered_;
    Imath::V3f albedo_sum_{0, 0, 0};
    float depth_sum_ = 0;
    std::uint32_t hits_ = 0;
    std::uint32_t casts_ = 0;
};

// Casts `count` rays, or as many more as fill the last row, on a jittered grid over the pixel
// whose upper left corner is (left, top).
void cast_grid(
    PixelGatherer& gatherer, float left, float top, std::uint32_t count, std::uint64_t key) {
    const auto columns =
        static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<float>(count))));
    const std::uint32_t rows = (count + columns - 1) / columns;
    for (std::uint32_t i = 0; i < columns * rows; ++i) {
        const std::uint64_t bits = transport::mix_bits(key + i);
        const float dx = (static_cast<float>(i % columns) + transport::unit_float(bits)) /
                         static_cast<float>(columns);
        const float dy =
            (static_cast<float>(i / columns) + transport::unit_float(bits << 32U)) /
            static_cast<float>(rows);
        gatherer.cast(left + dx, top + dy, std::hypot(dx - 0.5F, dy - 0.5F));
    }
}

}  // namespace

PixelView view_pixel(const RayCaster& caster,
                     const scene::Camera& camera,
                     std::uint32_t x,
                     std::uint32_t y,
                     std::uint32_t pixel_samples,
                     std::uint64_t seed) {
    PixelGatherer gatherer(caster, camera);
    const auto left = static_cast<float>(x);
    const auto top = static_cast<float>(y);
    gatherer.cast(left + 0.5F, top + 0.5F, 0);
    if (pixel_samples > 1) {
        const std::uint64_t key =
            transport::mix_bits(seed ^ (std::uint64_t{y} * camera.width() + x));
        cast_grid(gatherer, left, top, pixel_samples, key);
        if (gatherer.meets_edge() || gatherer.differs(left, top) ||
            gatherer.differs(left + 1, top) || gatherer.differs(left, top + 1) ||
            gatherer.differs(left + 1, top + 1)) {
            cast_grid(gatherer, left, top, kEdgeFactor * pixel_samples,
                      transport::mix_bits(key));
        }
    }
    return std::move(gatherer).view();
}

}  // namespace relume::bake
