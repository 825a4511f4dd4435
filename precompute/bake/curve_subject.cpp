#include "precompute/bake/curve_subject.h"

#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/curves/curve_rows.h"
#include "precompute/bake/fingerprint.h"
#include "precompute/bake/image_file.h"
#include "protocol/basis/curve_basis.h"

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

namespace relume::bake {
namespace {

// Receivers that were drawn, baked once more.
class CurveRebake {
  public:
    CurveRebake(const RayCaster& caster,
                const BakeParameters& parameters,
                const FrozenLight& light,
                const std::vector<EditedMaterial>& materials)
        : pixels_(caster, parameters),
          rows_(caster, pixels_, light, materials, parameters),
          signals_(rows_.signals()) {}

    [[nodiscard]] DrawnError error(const ClusterSample& sample) const {
        DrawnError error;
        std::vector<CoefficientRow> rows;
        for (std::size_t draw = 0; draw < sample.drawn; ++draw) {
            const SampledReceiver& drawn = sample.draws[draw];
            const double weight =
                1 / (drawn.probability * static_cast<double>(ClusterSample::kDraws));
            (void)rows_.bake_alone(drawn.receiver, rows);
            const LitColours again = signals_.colours(rows.front());
            add_products(weight / 2, drawn.baked, again, drawn.baked, again, error.noise);
        }
        return error;
    }

  private:
    PixelReceivers pixels_;
    CurveRows rows_;
    ModelSignals signals_;
};

}  // namespace

CurveSubject::CurveSubject(const RayCaster& caster,
                           const BakeParameters& parameters,
                           const FrozenLight& light,
                           const std::vector<EditedMaterial>& materials)
    : caster_(caster),
      parameters_(parameters),
      light_(light),
      materials_(materials),
      image_(caster, parameters) {}

std::unique_ptr<RowSource> CurveSubject::rows() const {
    return std::make_unique<CurveRows>(caster_, image_.pixels(), light_, materials_,
                                       parameters_);
}

transport::SamplingError CurveSubject::sampling_error(
    std::span<const ClusterSample> samples) const {
    BakeParameters with_other_seed = parameters_;
    with_other_seed.seed = other_seed(parameters_);
    const CurveRebake rebake(caster_, with_other_seed, light_, materials_);
    return measure_sampling_error(
        [&](std::uint32_t, const ClusterSample& sample) { return rebake.error(sample); },
        parameters_.seed, samples);
}

void CurveSubject::describe(transport::Manifest& manifest) const {
    image_.describe(manifest);
    manifest.kind = transport::Kind::curves;
    manifest.signal_basis = basis::CurveBasis(static_cast<std::uint32_t>(materials_.size()));
    transport::CurvesSection section{.curves = {}, .light = light_.description};
    for (const EditedMaterial& material : materials_) {
        section.curves.push_back(record_of(material));
    }
    manifest.bake["interreflection"] = "frozen";
    const std::string signal = json_from(section.curves).dump() + light_.description.dump();
    manifest.fingerprint = fingerprint_of(caster_.scene(), image_.pixels().camera(),
                                          parameters_, manifest.generator, signal);
    manifest.curves = std::move(section);
}

void CurveSubject::find_shown_materials() {
    const PixelReceivers& pixels = image_.pixels();
    shown_.assign(pixels.receiver_count(), 0);
    std::vector<std::atomic<bool>> is_seen(materials_.size());
    tbb::parallel_for(std::size_t{0}, pixels.receiver_count(), [&](std::size_t pixel) {
        std::vector<float> share(caster_.scene().materials.size());
        float open = 1;
        for (const ReceiverSurface& surface : pixels.look(pixel).surfaces) {
            share[surface.material] += surface.share;
            open -= surface.share;
        }
        const float most = std::max(open, *std::max_element(share.begin(), share.end()));
        for (std::size_t m = 0; m < materials_.size(); ++m) {
            const float of_material = share[materials_[m].material];
            if (of_material > 0) {
                is_seen[m] = true;
            }
            if (of_material > 0 && of_material == most) {
                shown_[pixel] = static_cast<std::uint8_t>(m + 1);
            }
        }
    });
    in_view_.assign(is_seen.begin(), is_seen.end());
}

nlohmann::json CurveSubject::measured() const {
    nlohmann::json materials = nlohmann::json::array();
    for (std::size_t m = 0; m < materials_.size(); ++m) {
        nlohmann::json notes = materials_[m].notes;
        notes["name"] = materials_[m].name;
        notes["in_view"] = static_cast<bool>(in_view_[m]);
        materials.push_back(std::move(notes));
    }
    return {{"materials", std::move(materials)}};
}

std::vector<float> CurveSubject::coverage() {
    std::vector<float> coverage = image_.coverage();
    std::fill(coverage.begin(), coverage.end(), 1.0F);
    find_shown_materials();
    return coverage;
}

void CurveSubject::write_files(const std::filesystem::path& directory) const {
    image_.write_files(directory);
    const transport::TileGrid& size = image_.pixels().image();
    FloatImage materials{size.width, size.height, 1, {}};
    for (const std::uint8_t shown : shown_) {
        materials.values.push_back(static_cast<float>(shown) / 255);
    }
    write_png(directory / "view" / "materials.png", materials);
}

}  // namespace relume::bake
