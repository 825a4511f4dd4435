#include "precompute/materials/field_baker.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

namespace relume::materials {
namespace {

double energy(std::span<const float> values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

void require_valid(const FieldParameters& parameters) {
    if (!basis::is_face_resolution(parameters.face_resolution)) {
        throw std::invalid_argument("face resolution is " +
                                    std::to_string(parameters.face_resolution) +
                                    ", expected a power of two from 4 to 256");
    }
    if (!(parameters.energy_fraction > 0 && parameters.energy_fraction <= 1)) {
        throw std::invalid_argument("fraction of energy is " +
                                    std::to_string(parameters.energy_fraction) +
                                    ", expected above 0 and at most 1");
    }
    if (parameters.samples_per_side < 1 || parameters.samples_per_side > 8) {
        throw std::invalid_argument("samples along a texel are " +
                                    std::to_string(parameters.samples_per_side) +
                                    ", expected 1 to 8");
    }
}

}  // namespace

std::vector<std::vector<float>> lobe_texels(const FieldModel& model,
                                            const TexelSamples& samples,
                                            const Imath::V3f& normal,
                                            const Imath::V3f& reflection) {
    const std::vector<float>& solid_angles = samples.solid_angles_sr();
    std::vector<float> values(model.lobe_count * solid_angles.size());
    model.evaluate(normal, reflection, samples.directions(), values);
    const std::size_t per_texel = samples.samples_per_texel();
    std::vector<std::vector<float>> texels(
        model.lobe_count, std::vector<float>(solid_angles.size() / per_texel, 0.0F));
    for (std::size_t lobe = 0; lobe < model.lobe_count; ++lobe) {
        for (std::size_t i = 0; i < solid_angles.size(); ++i) {
            texels[lobe][i / per_texel] +=
                values[lobe * solid_angles.size() + i] * solid_angles[i];
        }
    }
    return texels;
}

tripling::MaterialField bake_field(const FieldModel& model,
                                   const FieldParameters& parameters,
                                   FieldReport& report) {
    require_valid(parameters);
    const std::uint32_t n = parameters.face_resolution;
    tripling::MaterialField field;
    field.name = model.name;
    field.normals =
        tripling::DirectionGrid(model.depends_on_normal ? parameters.normal_side : 1);
    field.reflections =
        tripling::DirectionGrid(model.depends_on_reflection ? parameters.reflection_side : 1);
    field.energy_fraction = static_cast<float>(parameters.energy_fraction);
    field.lobes.assign(model.lobe_count, tripling::WaveletStore(n));
    report = {};
    const TexelSamples samples(n, parameters.samples_per_side);
    // In runs, so that no more is held than the field and some entries.
    constexpr std::size_t kRun = 1024;
    std::vector<std::vector<std::optional<tripling::SparseWavelets>>> run(kRun);
    std::vector<double> kept_energy(kRun);
    for (std::size_t first = 0; first < field.entry_count(); first += kRun) {
        const std::size_t count = std::min(kRun, field.entry_count() - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            const std::size_t entry = first + i;
            const std::size_t reflections = field.reflections.node_count();
            auto lobes =
                lobe_texels(model, samples, field.normals.direction(entry / reflections),
                            field.reflections.direction(entry % reflections));
            run[i].clear();
            kept_energy[i] = 1;
            for (std::vector<float>& coefficients : lobes) {
                basis::haar_forward_cubemap(n, coefficients);
                const auto& kept = run[i].emplace_back(tripling::SparseWavelets(
                    tripling::squares_of_energy(n, coefficients, parameters.energy_fraction),
                    coefficients));
                const double whole = energy(coefficients);
                if (whole > 0) {
                    kept_energy[i] =
                        std::min(kept_energy[i], energy(kept->coefficients()) / whole);
                }
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t lobe = 0; lobe < field.lobes.size(); ++lobe) {
                field.lobes[lobe].append(*run[i][lobe]);
                report.nonzero += run[i][lobe]->nonzero_count();
                ++report.entries;
            }
            report.least_energy = std::min(report.least_energy, kept_energy[i]);
        }
    }
    report.sparsity = static_cast<double>(report.nonzero) /
                      static_cast<double>(report.entries * basis::texel_count(n));
    return field;
}

}  // namespace relume::materials
