#include "tests/lab/triple/tabulated_material.h"

#include "precompute/materials/model_words.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace relume::lab {
namespace {

constexpr std::uint32_t kSamplesPerSide = 2;

// All forms of one entry.
struct Entry {
    std::vector<float> texels;  // in squares
    std::vector<tripling::SparseWavelets> wavelets;
};

float mean(const Imath::V3f& colour) {
    return (colour.x + colour.y + colour.z) / 3;
}

}  // namespace

std::size_t terms_of_fraction(std::uint32_t face_resolution, double fraction) {
    const auto wavelets =
        static_cast<double>(basis::texel_count(face_resolution) - basis::kFaceCount);
    return static_cast<std::size_t>(std::max(1.0, std::round(fraction * wavelets)));
}

std::vector<float> TabulatedMaterial::at(const Imath::V3f& normal,
                                         const Imath::V3f& reflection) const {
    const auto lobes = materials::lobe_texels(model_, samples_, normal, reflection);
    std::vector<float> sum(lobes.front().size(), 0.0F);
    for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
        const float weight = mean(model_.colours[lobe]);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += weight * lobes[lobe][i];
        }
    }
    return sum;
}

TabulatedMaterial::TabulatedMaterial(const std::string& words,
                                     std::uint32_t face_resolution,
                                     std::span<const double> fractions)
    : words_(words),
      model_(materials::model_from_words(words)),
      samples_(face_resolution, kSamplesPerSide),
      texels_(face_resolution),
      runs_(face_resolution) {
    const timing::Stopwatch watch;
    const std::uint32_t n = face_resolution;
    const materials::FieldParameters parameters = materials::usual_parameters(model_, n);
    tripling::MaterialField empty;
    empty.name = model_.name;
    empty.normals =
        tripling::DirectionGrid(model_.depends_on_normal ? parameters.normal_side : 1);
    empty.reflections =
        tripling::DirectionGrid(model_.depends_on_reflection ? parameters.reflection_side : 1);
    empty.lobes.assign(1, tripling::WaveletStore(n));
    empty.colours = {Imath::V3f(1)};
    fields_.assign(fractions.size(), empty);
    sparsity_.assign(fractions.size(), 0);
    constexpr std::size_t kRun = 256;  // entries at a time
    std::vector<Entry> run(kRun);
    const std::size_t entries = empty.entry_count();
    const std::size_t reflections = empty.reflections.node_count();
    for (std::size_t first = 0; first < entries; first += kRun) {
        const std::size_t count = std::min(kRun, entries - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            const std::size_t entry = first + i;
            std::vector<float> texels = at(empty.normals.direction(entry / reflections),
                                           empty.reflections.direction(entry % reflections));
            run[i].texels = tripling::values_in_blocks(n, texels);
            basis::haar_forward_cubemap(n, texels);
            run[i].wavelets.clear();
            for (const double fraction : fractions) {
                run[i].wavelets.emplace_back(
                    tripling::largest_squares(n, texels, terms_of_fraction(n, fraction),
                                              tripling::TermOrder::by_size)
                        .with_ancestors(),
                    texels);
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            texels_.append(run[i].texels, 0);
            runs_.append(run[i].texels, kLeftOff);
            for (std::size_t f = 0; f < fractions.size(); ++f) {
                fields_[f].lobes.front().append(run[i].wavelets[f]);
                sparsity_[f] += static_cast<double>(run[i].wavelets[f].nonzero_count());
            }
        }
    }
    for (double& sparsity : sparsity_) {
        sparsity /= static_cast<double>(entries * basis::texel_count(n));
    }
    seconds_ = watch.seconds();
}

}  // namespace relume::lab
