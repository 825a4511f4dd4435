#include "precompute/bake/curve_subject.h"

#include "precompute/bake/blocks/sampling_error.h"
#include "precompute/bake/curves/curve_rows.h"
#include "precompute/bake/fingerprint.h"
#include "protocol/basis/curve_basis.h"

#include <nlohmann/json.hpp>

#include <algorithm>
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

nlohmann::json CurveSubject::measured() const {
    nlohmann::json materials = nlohmann::json::array();
    for (std::size_t m = 0; m < materials_.size(); ++m) {
        nlohmann::json notes = materials_[m].notes;
        notes["name"] = materials_[m].name;
        notes["in_view"] = static_cast<bool>(shown_.in_view[m]);
        materials.push_back(std::move(notes));
    }
    return {{"materials", std::move(materials)}};
}

std::vector<float> CurveSubject::coverage() {
    std::vector<float> coverage = image_.coverage();
    std::fill(coverage.begin(), coverage.end(), 1.0F);
    std::vector<std::uint32_t> edited;
    for (const EditedMaterial& material : materials_) {
        edited.push_back(material.material);
    }
    shown_ = shown_materials(image_.pixels(), edited, caster_.scene().materials.size());
    return coverage;
}

void CurveSubject::write_files(const std::filesystem::path& directory) const {
    image_.write_files(directory);
    write_shown_materials(directory, shown_);
}

}  // namespace relume::bake
