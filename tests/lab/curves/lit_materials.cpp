#include "tests/lab/curves/lit_materials.h"

#include "protocol/base/timing/stopwatch.h"
#include "server/engine/session.h"
#include "server/materials/material_layer.h"
#include "server/view/tile_addend.h"
#include "tests/lab/curves/curve_edits.h"
#include "tests/support/picture_maker.h"

#include <cmath>
#include <utility>

namespace relume::lab {
namespace {

using materials::EditablePoints;
using materials::MaterialLayer;
using materials::ShownMaterial;

constexpr double kSlice = 8;  // milliseconds, as a room's share

// All pixels of all tiles that a layer adds to.
std::vector<float> added_by(const MaterialLayer& layer, std::uint32_t tiles) {
    constexpr std::size_t kRow = std::size_t{3} * transport::kTileSide;
    constexpr std::size_t kTile = kRow * transport::kTileSide;
    std::vector<float> rgb(tiles * kTile, 0);
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
        layer.add_to_tile(tile, &rgb[tile * kTile], kRow);
    }
    return rgb;
}

double distance(const std::vector<float>& found, const std::vector<float>& expected) {
    double error = 0;
    double norm = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        error += std::pow(double{found[i]} - double{expected[i]}, 2);
        norm += std::pow(double{expected[i]}, 2);
    }
    return norm > 0 ? std::sqrt(error / norm) : 0;
}

ShownMaterial shown_with(const EditablePoints& points,
                         std::size_t material,
                         const curve::Curve& curve) {
    return {.material = material,
            .brdf = points.materials()[material].brdf.with_curve(0, curve)};
}

curve::Curve half_as_high(curve::Curve curve) {
    for (auto& channel : curve.rgb) {
        for (float& sample : channel) {
            sample /= 2;
        }
    }
    return curve;
}

std::size_t points_of(const EditablePoints& points, std::size_t material) {
    std::size_t count = 0;
    for (const std::uint32_t tile : points.materials()[material].tiles) {
        for (const transport::SeenPoint& point : points.points(tile)) {
            count += point.material == material ? 1U : 0U;
        }
    }
    return count;
}

// Works until `is_done`; seconds.
template <typename Done>
double work(MaterialLayer& layer, const Done& is_done) {
    const timing::Stopwatch watch;
    while (!is_done()) {
        (void)layer.advance(kSlice);
    }
    return watch.seconds();
}

void take_up(MaterialLayer& layer,
             const light::LightCubemap& light,
             const ShownMaterial& shown,
             std::uint32_t tiles,
             LitMaterial& found) {
    layer.set_shown({shown});
    layer.set_light(light);
    layer.set_shown({});
    layer.set_shown({shown});  // an edit, so that its first look is awaited
    found.first_look_s = work(layer, [&] { return !layer.awaits_first_look(); });
    const std::vector<float> first_look = added_by(layer, tiles);
    found.columns_s = found.first_look_s + work(layer, [&] { return layer.has_columns(); });
    const std::vector<float> columns = added_by(layer, tiles);
    found.whole_s = found.columns_s + work(layer, [&] { return layer.is_whole(); });
    const std::vector<float> whole = added_by(layer, tiles);
    found.first_look_error = distance(first_look, whole);
    found.columns_error = distance(columns, whole);
    found.bytes = layer.bytes();
}

}  // namespace

std::vector<LitMaterial> take_up_curves(const std::shared_ptr<const served::Scene>& scene,
                                        const light::LightCubemap& light,
                                        std::uint32_t images) {
    const std::shared_ptr<const EditablePoints> points = scene->editable_points();
    engine::Session session(scene->workspace(), {});
    std::vector<float> coefficients;
    light::lighting_coefficients(light, scene->projection(), coefficients);
    session.set_target(coefficients);
    while (!session.exact()) {
        (void)session.advance({.milliseconds = 1000, .coefficients = {}, .target_error = 0});
    }
    std::vector<LitMaterial> all;
    for (std::size_t material = 0; material < points->materials().size(); ++material) {
        MaterialLayer layer(points, materials::kUsualMaterialBytes);
        LitMaterial found{.id = points->materials()[material].id,
                          .points = points_of(*points, material)};
        const curve::Curve& baked = points->materials()[material].brdf.curves()[0].curve;
        take_up(layer, light, shown_with(*points, material, half_as_high(baked)),
                scene->image().block_count(), found);
        test::PictureMaker pictures(
            std::make_unique<view::AddedView>(scene->make_view(), layer));
        const timing::Stopwatch watch;
        for (std::uint32_t image = 0; image < images; ++image) {
            layer.set_shown({shown_with(*points, material,
                                        changed_curve(baked, CurveChange::local, image))});
            (void)layer.advance(kSlice);
            pictures.begin(session.sums(), {});
        }
        (void)pictures.finish();
        found.images_per_s = images / watch.seconds();
        all.push_back(std::move(found));
    }
    return all;
}

}  // namespace relume::lab
