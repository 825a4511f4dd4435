#include "precompute/materials/field_baker.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
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

// Of one pair of directions.
struct BakedEntry {
    std::vector<tripling::SparseWavelets> lobes;
    double kept_energy = 1;  // least of all lobes
};

struct Grids {
    tripling::DirectionGrid normals;
    tripling::DirectionGrid reflections;

    Grids(const FieldModel& model, const FieldParameters& parameters)
        : normals(model.depends_on_normal ? parameters.normal_side : 1),
          reflections(model.depends_on_reflection ? parameters.reflection_side : 1) {}

    [[nodiscard]] std::size_t entry_count() const {
        return normals.node_count() * reflections.node_count();
    }
};

BakedEntry bake_entry(const FieldModel& model,
                      const FieldParameters& parameters,
                      const TexelSamples& samples,
                      const Grids& grids,
                      std::size_t entry) {
    const std::uint32_t n = parameters.face_resolution;
    const std::size_t reflections = grids.reflections.node_count();
    auto lobes = lobe_texels(model, samples, grids.normals.direction(entry / reflections),
                             grids.reflections.direction(entry % reflections));
    BakedEntry baked;
    for (std::vector<float>& coefficients : lobes) {
        basis::haar_forward_cubemap(n, coefficients);
        const auto& kept = baked.lobes.emplace_back(
            tripling::squares_of_energy(n, coefficients, parameters.energy_fraction),
            coefficients);
        const double whole = energy(coefficients);
        if (whole > 0) {
            baked.kept_energy =
                std::min(baked.kept_energy, energy(kept.coefficients()) / whole);
        }
    }
    return baked;
}

std::size_t byte_count(const std::vector<tripling::WaveletStore>& lobes) {
    std::size_t bytes = 0;
    for (const tripling::WaveletStore& lobe : lobes) {
        bytes += lobe.byte_count();
    }
    return bytes;
}

}  // namespace

FieldParameters usual_parameters(const FieldModel& model, std::uint32_t face_resolution) {
    FieldParameters parameters;
    parameters.face_resolution = face_resolution;
    const bool has_both = model.depends_on_normal && model.depends_on_reflection;
    // As [Ng04 §7.1.2] has them: what follows the reflection changes slowly with the normal.
    parameters.normal_side = has_both ? 3 : 9;
    const double step = model.width_rad / (has_both ? 2 : 3);
    const double quarter_turn = std::numbers::pi / 2;
    const double most = has_both ? 17 : tripling::DirectionGrid::kMostSide;
    parameters.reflection_side =
        static_cast<std::uint32_t>(std::clamp(1 + std::ceil(quarter_turn / step), 5.0, most));
    return parameters;
}

FieldSize field_size(const FieldModel& model, const FieldParameters& parameters) {
    require_valid(parameters);
    constexpr std::size_t kSampled = 48;
    const Grids grids(model, parameters);
    const TexelSamples samples(parameters.face_resolution, parameters.samples_per_side);
    const std::size_t sampled = std::min(kSampled, grids.entry_count());
    std::vector<std::size_t> bytes(sampled);
    tbb::parallel_for(std::size_t{0}, sampled, [&](std::size_t i) {
        // Entries far from each other in both grids.
        const std::size_t entry = (2 * i + 1) * grids.entry_count() / (2 * sampled);
        std::vector<tripling::WaveletStore> stores(
            model.lobe_count, tripling::WaveletStore(parameters.face_resolution));
        const BakedEntry baked = bake_entry(model, parameters, samples, grids, entry);
        for (std::size_t lobe = 0; lobe < stores.size(); ++lobe) {
            stores[lobe].append(baked.lobes[lobe]);
        }
        bytes[i] = byte_count(stores);
    });
    const std::size_t of_sampled = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
    const std::size_t most_of_entry =
        tripling::WaveletStore::most_bytes(parameters.face_resolution);
    return {.entries = grids.entry_count() * model.lobe_count,
            .expected_bytes = of_sampled / sampled * grids.entry_count(),
            .bound_bytes = std::min(parameters.most_bytes,
                                    grids.entry_count() * model.lobe_count * most_of_entry)};
}

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
    const Grids grids(model, parameters);
    tripling::MaterialField field;
    field.name = model.name;
    field.normals = grids.normals;
    field.reflections = grids.reflections;
    field.energy_fraction = static_cast<float>(parameters.energy_fraction);
    field.lobes.assign(model.lobe_count, tripling::WaveletStore(n));
    field.colours = model.colours;
    report = {};
    const TexelSamples samples(n, parameters.samples_per_side);
    // In runs, so that no more is held than the field and some entries.
    constexpr std::size_t kRun = 1024;
    std::vector<BakedEntry> run(kRun);
    for (std::size_t first = 0; first < field.entry_count(); first += kRun) {
        const std::size_t count = std::min(kRun, field.entry_count() - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            run[i] = bake_entry(model, parameters, samples, grids, first + i);
        });
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t lobe = 0; lobe < field.lobes.size(); ++lobe) {
                field.lobes[lobe].append(run[i].lobes[lobe]);
                report.nonzero += run[i].lobes[lobe].nonzero_count();
                ++report.entries;
            }
            report.least_energy = std::min(report.least_energy, run[i].kept_energy);
        }
        if (field.byte_count() > parameters.most_bytes) {
            throw std::length_error("a field passes " +
                                    std::to_string(parameters.most_bytes >> 20U) +
                                    " MiB, the most that it may take");
        }
    }
    report.sparsity = static_cast<double>(report.nonzero) /
                      static_cast<double>(report.entries * basis::texel_count(n));
    return field;
}

}  // namespace relume::materials
