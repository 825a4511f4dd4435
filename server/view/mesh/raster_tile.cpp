#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/view/mesh/raster_tile.cpp"
#include "server/view/mesh/raster_tile.h"

#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace relume::view::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct PixelRange {
    std::size_t first;
    std::size_t end;
};

// Those whose samples, at `begin` + i, lie between the bounds.
HWY_INLINE PixelRange pixels_between(double lower, double upper, double begin) {
    const double first = std::clamp(std::ceil(lower - begin), 0.0, double{kRasterSide});
    const double end = std::clamp(std::floor(upper - begin) + 1, 0.0, double{kRasterSide});
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(end)};
}

HWY_INLINE void draw_triangle(const ProjectedTriangle& triangle,
                              double begin_x,
                              double begin_y,
                              RasterTile& tile) {
    const hn::CappedTag<double, 8> d;
    const hn::Rebind<float, decltype(d)> df;
    const hn::Rebind<std::uint32_t, decltype(d)> du;
    const PixelRange columns = pixels_between(triangle.left, triangle.right, begin_x);
    const PixelRange rows = pixels_between(triangle.top, triangle.bottom, begin_y);
    const auto zero = hn::Zero(d);
    const auto slope_0 = hn::Set(d, triangle.edges[0].x);
    const auto slope_1 = hn::Set(d, triangle.edges[1].x);
    const auto slope_2 = hn::Set(d, triangle.edges[2].x);
    const auto nearness_of_weight = hn::Set(d, triangle.nearness_of_weight);
    const auto number = hn::Set(du, triangle.triangle);
    const auto lanes = hn::Iota(d, 0.0);
    for (std::size_t y = rows.first; y < rows.end; ++y) {
        const double at_y = begin_y + static_cast<double>(y);
        const auto row_value = [&](std::size_t edge) {
            return triangle.edges[edge].y * at_y + triangle.edges[edge].constant;
        };
        const auto row_0 = hn::Set(d, row_value(0));
        const auto row_1 = hn::Set(d, row_value(1));
        const auto row_2 = hn::Set(d, row_value(2));
        for (std::size_t x = columns.first; x < columns.end; x += hn::Lanes(d)) {
            const auto at_x = hn::Add(lanes, hn::Set(d, begin_x + static_cast<double>(x)));
            const auto weight_0 = hn::Add(hn::Mul(slope_0, at_x), row_0);
            const auto weight_1 = hn::Add(hn::Mul(slope_1, at_x), row_1);
            const auto weight_2 = hn::Add(hn::Mul(slope_2, at_x), row_2);
            const auto least = hn::Min(hn::Min(weight_0, weight_1), weight_2);
            const auto is_hit = hn::Ge(least, zero);
            if (hn::AllFalse(d, is_hit)) {
                continue;
            }
            const std::size_t at = y * RasterTile::kRow + x;
            const auto sum = hn::Add(hn::Add(weight_0, weight_1), weight_2);
            const auto nearness =
                hn::DemoteTo(df, hn::IfThenElseZero(is_hit, hn::Mul(sum, nearness_of_weight)));
            const auto before = hn::LoadU(df, &tile.nearness[at]);
            const auto is_nearer = hn::Gt(nearness, before);
            if (hn::AllFalse(df, is_nearer)) {
                continue;
            }
            const auto share = [&](auto weight, float* kept) HWY_ATTR {
                const auto value = hn::DemoteTo(df, hn::Div(weight, sum));
                hn::StoreU(hn::IfThenElse(is_nearer, value, hn::LoadU(df, kept)), df, kept);
            };
            share(weight_1, &tile.weight_1[at]);
            share(weight_2, &tile.weight_2[at]);
            hn::StoreU(hn::IfThenElse(is_nearer, nearness, before), df, &tile.nearness[at]);
            hn::StoreU(hn::IfThenElse(hn::RebindMask(du, is_nearer), number,
                                      hn::LoadU(du, &tile.triangle[at])),
                       du, &tile.triangle[at]);
        }
    }
}

void draw_triangles(std::span<const ProjectedTriangle> triangles,
                    std::span<const std::uint32_t> numbers,
                    double begin_x,
                    double begin_y,
                    RasterTile& tile) {
    for (const std::uint32_t number : numbers) {
        draw_triangle(triangles[number], begin_x, begin_y, tile);
    }
}

}  // namespace
}  // namespace relume::view::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::view {

HWY_EXPORT(draw_triangles);

void RasterTile::clear() {
    nearness.fill(0);
    triangle.fill(kNoTriangle);
    weight_1.fill(0);
    weight_2.fill(0);
}

void draw(std::span<const ProjectedTriangle> triangles,
          std::span<const std::uint32_t> numbers,
          std::uint32_t left,
          std::uint32_t top,
          const SamplePosition& sample,
          RasterTile& tile) {
    engine::apply_forced_target();
    HWY_DYNAMIC_DISPATCH(draw_triangles)
    (triangles, numbers, left + sample.x, top + sample.y, tile);
}

}  // namespace relume::view
#endif
