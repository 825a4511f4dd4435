#include "precompute/bake/fields/pixel_points.h"

#include "protocol/transport/materials_section.h"

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

static_assert(kMostPointsOfPixel >= transport::MaterialsSection::kMostMaterials);

struct Surface {
    const ReceiverSurface* surface = nullptr;
    float share = 0;
    std::uint32_t points = 1;
};

std::uint32_t points_of(const ReceiverSurface& surface) {
    const auto of = [&](std::uint32_t most) {
        const auto wanted =
            static_cast<std::uint32_t>(std::ceil(surface.share * static_cast<float>(most)));
        return std::min(wanted, most);
    };
    return surface.turns.empty() ? of(kMostAlikePoints)
                                 : std::min(of(kMostTurnPoints),
                                            static_cast<std::uint32_t>(surface.turns.size()));
}

// Whether another surface of its material stands for it as well.
bool has_other(std::span<const Surface> surfaces, const Surface& one) {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& other) {
        return other.surface != one.surface && other.surface->material == one.surface->material;
    });
}

// One point for each surface, and the smallest surfaces left out: the largest of the same
// material stands for them.
void make_few(std::vector<Surface>& surfaces) {
    for (Surface& one : surfaces) {
        one.points = 1;
    }
    while (surfaces.size() > kMostPointsOfPixel) {
        auto least = surfaces.end();
        for (auto one = surfaces.begin(); one != surfaces.end(); ++one) {
            if (has_other(surfaces, *one) &&
                (least == surfaces.end() || one->share < least->share)) {
                least = one;
            }
        }
        auto most = surfaces.end();
        for (auto one = surfaces.begin(); one != surfaces.end(); ++one) {
            if (one != least && one->surface->material == least->surface->material &&
                (most == surfaces.end() || one->share > most->share)) {
                most = one;
            }
        }
        most->share += least->share;
        surfaces.erase(least);
    }
}

// Of the next rays in each texel: by Roberts' R2 sequence, as the further rays of a row.
JitterShift moved(JitterShift shift, std::uint32_t count) {
    constexpr float kColumnStep = 0.75487767F;
    constexpr float kRowStep = 0.56984029F;
    const auto wrapped = [](float x) { return x >= 1 ? x - 1 : x; };
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            shift.column[lane] = wrapped(shift.column[lane] + kColumnStep);
            shift.row[lane] = wrapped(shift.row[lane] + kRowStep);
        }
    }
    return shift;
}

transport::SeenPoint seen_point(const scene::SurfacePoint& point,
                                const Imath::V3f& diffuse,
                                std::uint8_t material,
                                float share) {
    return {.slot = 0,
            .material = material,
            .share = share,
            .normal = point.shading.normal,
            .geometric_normal = point.geometric_normal,
            .wo = point.shading.to_world(point.wo),
            .diffuse = diffuse};
}

}  // namespace

std::vector<PixelPoint> points_of_pixel(const Receiver& receiver,
                                        const EditableIndices& editable,
                                        std::uint64_t seed) {
    std::vector<Surface> surfaces;
    std::size_t count = 0;
    for (const ReceiverSurface& surface : receiver.surfaces) {
        if (editable[surface.material]) {
            surfaces.push_back(
                {.surface = &surface, .share = surface.share, .points = points_of(surface)});
            count += surfaces.back().points;
        }
    }
    if (count > kMostPointsOfPixel) {
        make_few(surfaces);
    }
    std::vector<PixelPoint> points;
    for (const Surface& one : surfaces) {
        const ReceiverSurface& surface = *one.surface;
        const Imath::V3f& diffuse = surface.point.bsdf.diffuse_colour();
        const bool turns = one.points > 1 && !surface.turns.empty();
        const JitterShift first = jitter_shift(receiver.place, surface.number, seed);
        for (std::uint32_t i = 0; i < one.points; ++i) {
            const scene::SurfacePoint& point = turns ? surface.turns[i] : surface.point;
            LookingPoint looking{.origins = surface.origins,
                                 .geometric_normal = point.geometric_normal,
                                 .shift = moved(first, i),
                                 .looks_again = i > 0 && !turns};
            if (turns) {
                looking.origins.fill(offset_origin(point));
            }
            points.push_back({.seen = seen_point(point, diffuse, *editable[surface.material],
                                                 one.share / static_cast<float>(one.points)),
                              .looking = looking});
        }
    }
    return points;
}

}  // namespace relume::bake
