#include "precompute/bake/curves/curve_rows.h"

#include "precompute/bake/curves/curve_signals.h"
#include "protocol/basis/cubemap_projection.h"
#include "protocol/basis/curve_basis.h"
#include "protocol/basis/daubechies4.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::bake {
namespace {

std::vector<std::optional<std::uint32_t>> curves_by_material(
    const scene::Scene& scene, const std::vector<EditedMaterial>& materials) {
    std::vector<std::optional<std::uint32_t>> curves(scene.materials.size());
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
        curves[materials[m].material] = m;
    }
    return curves;
}

std::vector<bool> edited(const std::vector<std::optional<std::uint32_t>>& curves) {
    std::vector<bool> is_edited;
    for (const auto& curve : curves) {
        is_edited.push_back(curve.has_value());
    }
    return is_edited;
}

void reset(CoefficientRow& row, std::size_t columns) {
    for (auto& plane : row.rgb) {
        plane.assign(columns, 0.0F);
    }
    // Columns of one pixel have colours that have nothing in common.
    row.white = row.direct_white = Imath::V3f(1, 1, 1);
}

}  // namespace

CurveRows::CurveRows(const RayCaster& caster,
                     const PixelReceivers& pixels,
                     const FrozenLight& light,
                     const std::vector<EditedMaterial>& materials,
                     const BakeParameters& parameters)
    : pixels_(pixels),
      materials_(materials),
      curve_of_material_(curves_by_material(caster.scene(), materials)),
      background_(light.rig),
      texel_light_(light.cubemap),
      radiance_(caster, texel_light_, parameters.bounces),
      estimator_(radiance_, parameters.samples, parameters.seed),
      unedited_(pixels, edited(curve_of_material_)),
      signals_(curve_signals(materials)) {
    if (materials.size() < caster.scene().materials.size()) {
        light_rows_ = std::make_unique<LightRows>(caster, unedited_, parameters);
        const auto projection = basis::CubemapProjection::onto(signal_basis(parameters));
        const auto planes = light.cubemap.planes();
        for (std::size_t c = 0; c < 3; ++c) {
            light_[c].resize(projection->basis().coefficient_count());
            projection->project_radiance(planes[c], light_[c]);
        }
    }
}

std::uint64_t CurveRows::move_to(std::uint32_t first_cluster, std::uint32_t cluster_count) {
    return light_rows_ ? light_rows_->move_to(first_cluster, cluster_count) : 0;
}

bool CurveRows::bake(std::size_t receiver,
                     std::vector<CoefficientRow>& rows,
                     std::uint64_t& rays) const {
    rows.resize(1);
    bake_edited(receiver, rows.front(), rays);
    std::vector<CoefficientRow>& light = scratches_.local().light;
    if (light_rows_ && light_rows_->bake(receiver, light, rays)) {
        add_unedited(light.front(), rows.front());
    }
    return true;
}

bool CurveRows::bake_alone(std::size_t receiver, std::vector<CoefficientRow>& rows) const {
    rows.resize(1);
    std::uint64_t rays = 0;
    bake_edited(receiver, rows.front(), rays);
    std::vector<CoefficientRow>& light = scratches_.local().light;
    if (light_rows_ && light_rows_->bake_alone(receiver, light)) {
        add_unedited(light.front(), rows.front());
    }
    return true;
}

void CurveRows::bake_edited(std::size_t receiver,
                            CoefficientRow& row,
                            std::uint64_t& rays) const {
    const basis::CurveBasis basis(static_cast<std::uint32_t>(materials_.size()));
    reset(row, basis.coefficient_count());
    const Receiver seen = pixels_.look(receiver);
    CurveShares& shares = scratches_.local().shares;
    for (const ReceiverSurface& surface : seen.surfaces) {
        const auto m = curve_of_material_[surface.material];
        if (!m) {
            continue;
        }
        estimator_.estimate(surface, seen.place, materials_[*m], shares, rays);
        const std::size_t first = basis.first_coefficient(*m);
        for (std::size_t c = 0; c < 3; ++c) {
            row.rgb[c][first] += surface.share * shares.diffuse[static_cast<int>(c)];
            std::array<float, curve::kCurveSamples>& of_colour = shares.samples[c];
            basis::daubechies4_forward(of_colour, of_colour);
            for (std::size_t j = 0; j < of_colour.size(); ++j) {
                row.rgb[c][first + 1 + j] += surface.share * of_colour[j];
            }
        }
    }
    Imath::V3f rest{0, 0, 0};
    add_background(seen, rest);
    for (std::size_t c = 0; c < 3; ++c) {
        row.rgb[c][basis::CurveBasis::kRest] = rest[static_cast<int>(c)];
    }
}

// protocol/light.md §5.
void CurveRows::add_background(const Receiver& seen, Imath::V3f& rest) const {
    float open = 1;
    for (const ReceiverSurface& surface : seen.surfaces) {
        open -= surface.share;
    }
    constexpr float kRounding = 1e-5F;
    if (open < kRounding) {
        return;
    }
    const scene::Camera& camera = pixels_.camera();
    const auto x = static_cast<float>(seen.index % camera.width());
    const auto y = static_cast<float>(seen.index / camera.width());
    const Imath::V3f direction = camera.direction_from_pixel(x + 0.5F, y + 0.5F);
    const float cosine = direction.dot(camera.forward());
    const float footprint_sr =
        4 * camera.tan_half_width() * camera.tan_half_height() /
        (static_cast<float>(camera.width()) * static_cast<float>(camera.height())) * cosine *
        cosine * cosine;
    rest += background_.radiance(direction, footprint_sr) * open;
}

void CurveRows::add_unedited(const CoefficientRow& light, CoefficientRow& row) const {
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t j = 0; j < light_[c].size(); ++j) {
            sum += double{light.rgb[c][j]} * double{light_[c][j]};
        }
        row.rgb[c][basis::CurveBasis::kRest] += static_cast<float>(sum);
    }
}

}  // namespace relume::bake
