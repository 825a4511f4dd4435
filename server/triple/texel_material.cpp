#include "server/triple/texel_material.h"

#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace relume::triple {
namespace {

// An entry back in texels, in squares.
std::vector<float> texels_of(std::uint32_t n, const tripling::WaveletView& entry) {
    std::vector<float> texels(basis::texel_count(n), 0.0F);
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        float* of_face = &texels[face * n * n];
        of_face[0] = entry.scaling[face];
        for (std::uint32_t i = entry.first[face]; i < entry.first[face + 1]; ++i) {
            const auto square = tripling::square_from_index(entry.squares[i]);
            for (std::size_t m = 0; m < tripling::kWaveletTypes.size(); ++m) {
                of_face[tripling::coefficient_from_wavelet(
                    n, square, tripling::kWaveletTypes[m])] = entry.values[i][m + 1];
            }
        }
    }
    basis::haar_inverse_cubemap(n, texels);
    return tripling::values_in_blocks(n, texels);
}

}  // namespace

TexelMaterial::TexelMaterial(const tripling::MaterialField& field)
    : name_(field.name),
      normals_(field.normals),
      reflections_(field.reflections),
      colours_(field.colours) {
    const std::uint32_t n = field.face_resolution();
    constexpr std::size_t kRun = 1024;  // entries at a time
    std::vector<std::vector<float>> run(kRun);
    for (const tripling::WaveletStore& of_lobe : field.lobes) {
        tripling::TexelStore& lobe = lobes_.emplace_back(n);
        for (std::size_t first = 0; first < of_lobe.size(); first += kRun) {
            const std::size_t count = std::min(kRun, of_lobe.size() - first);
            tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
                run[i] = texels_of(n, of_lobe.view(first + i));
            });
            for (std::size_t i = 0; i < count; ++i) {
                lobe.append(run[i], kLeftOff);
            }
        }
    }
}

std::size_t TexelMaterial::byte_count() const {
    std::size_t bytes = 0;
    for (const tripling::TexelStore& lobe : lobes_) {
        bytes += lobe.byte_count();
    }
    return bytes;
}

Radiance TexelMaterial::radiance(const Imath::V3f& normal,
                                 const Imath::V3f& reflection,
                                 std::span<const std::uint64_t> open,
                                 const engine::ColourPlanes& planes,
                                 std::span<const Imath::V3f> colours) const {
    std::array<engine::WeightedTexels, engine::kMostMixed> parts;
    const tripling::FieldPlace place =
        tripling::place_in_grids(normals_, reflections_, normal, reflection);
    Radiance sum{};
    for (std::size_t lobe = 0; lobe < lobes_.size(); ++lobe) {
        for (std::size_t i = 0; i < place.count; ++i) {
            parts[i] = {.weight = place.entries[i].weight,
                        .function = lobes_[lobe].view(place.entries[i].index)};
        }
        const Radiance of_lobe =
            engine::sum_open_mixture(open, planes, std::span(parts).first(place.count));
        for (std::size_t c = 0; c < sum.size(); ++c) {
            sum[c] += colours[lobe][static_cast<int>(c)] * of_lobe[c];
        }
    }
    return sum;
}

}  // namespace relume::triple
