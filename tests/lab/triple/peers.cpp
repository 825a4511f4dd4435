#include "tests/lab/triple/peers.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "server/engine/kernels/open_mixture.h"
#include "server/engine/kernels/open_texels.h"
#include "tests/lab/triple/published_integral.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

namespace relume::lab {
namespace {

tripling::FieldPlace place_of(const TabulatedMaterial& material, const SeenVertex& seen) {
    return tripling::place_in_field(material.field(0), seen.normal, seen.reflection);
}

using Coefficients = std::vector<float>;

void fill_visibility(std::uint32_t n,
                     const tripling::VisibilityView& view,
                     std::span<const std::array<std::uint32_t, 3>> places,
                     Coefficients& coefficients) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0F);
    const std::size_t stride = tripling::face_stride(n);
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        float* of_face = &coefficients[face * n * n];
        of_face[0] = view.faces[face].scaling;
        for (std::size_t word = 0; word < stride / tripling::kWordBits; ++word) {
            const std::size_t first = face * stride / tripling::kWordBits;
            for (std::uint64_t bits = view.words[first + word]; bits != 0; bits &= bits - 1) {
                const std::size_t within = word * tripling::kWordBits +
                                           static_cast<std::size_t>(std::countr_zero(bits));
                std::array<float, 3> values{};
                (void)tripling::read_visible_square(n, view, face, within, values.data());
                for (std::size_t m = 0; m < 3; ++m) {
                    of_face[places[within][m]] = values[m];
                }
            }
        }
    }
}

void fill_material(std::uint32_t n,
                   const tripling::WaveletStore& store,
                   const tripling::FieldPlace& place,
                   std::span<const std::array<std::uint32_t, 3>> places,
                   Coefficients& coefficients) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0F);
    for (std::size_t part = 0; part < place.count; ++part) {
        const tripling::WaveletView view = store.view(place.entries[part].index);
        const float weight = place.entries[part].weight;
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            float* of_face = &coefficients[face * n * n];
            of_face[0] += weight * view.scaling[face];
            for (std::uint32_t s = view.first[face]; s < view.first[face + 1]; ++s) {
                for (std::size_t m = 0; m < 3; ++m) {
                    of_face[places[view.squares[s]][m]] += weight * view.values[s][m + 1];
                }
            }
        }
    }
}

// The visibility of a vertex as [Ng04] keeps it.
struct HashedVisibility {
    std::array<float, 6> scaling{};
    PublishedIntegral::Table squares;
};

HashedVisibility hashed(const tripling::VisibilityWavelets& wavelets, std::size_t vertex) {
    HashedVisibility table;
    const tripling::SparseWavelets sparse = wavelets.sparse(vertex);
    std::copy(sparse.scaling().begin(), sparse.scaling().end(), table.scaling.begin());
    std::size_t i = 0;
    sparse.squares().for_each([&](std::size_t square) {
        table.squares.emplace(static_cast<std::uint32_t>(square), sparse.values()[i++]);
    });
    return table;
}

}  // namespace

TripleWay sublinear_way(const SeenSurface& surface,
                        const TabulatedMaterial& material,
                        std::size_t fraction,
                        const TripleLight& light,
                        const tripling::SquareSet& light_terms) {
    return sublinear_way_at(surface, surface.seen(), material, fraction, light, light_terms);
}

TripleWay sublinear_way_at(const SeenSurface& surface,
                           std::span<const SeenVertex> all_seen,
                           const TabulatedMaterial& material,
                           std::size_t fraction,
                           const TripleLight& light,
                           const tripling::SquareSet& light_terms) {
    return {"sublinear", [&surface, all_seen, &material, fraction, &light, &light_terms] {
                auto workspace =
                    std::make_shared<engine::TripleWorkspace>(surface.face_resolution());
                const tripling::WaveletStore& store = material.field(fraction).lobes.front();
                return [&surface, all_seen, &material, &store, &light, &light_terms,
                        workspace](std::size_t i) {
                    const SeenVertex& seen = all_seen[i];
                    const tripling::FieldPlace place = place_of(material, seen);
                    std::array<engine::WeightedWavelets, 16> parts;
                    for (std::size_t part = 0; part < place.count; ++part) {
                        parts[part] = {.weight = place.entries[part].weight,
                                       .function = store.view(place.entries[part].index)};
                    }
                    engine::multiply_visibility(surface.wavelets().point(seen.vertex),
                                                std::span(parts).first(place.count),
                                                light_terms.words(), *workspace);
                    return engine::sum_light(light.table(), *workspace);
                };
            }};
}

TripleWay published_way(const SeenSurface& surface,
                        const TabulatedMaterial& material,
                        std::size_t fraction,
                        const TripleLight& light,
                        const tripling::SquareSet& light_terms) {
    return {
        "published", [&surface, &material, fraction, &light, &light_terms] {
            // Of the vertices that are asked for: their tables are made before.
            auto tables = std::make_shared<std::unordered_map<std::size_t, HashedVisibility>>();
            auto integral = std::make_shared<PublishedIntegral>(light, light_terms);
            const tripling::WaveletStore& store = material.field(fraction).lobes.front();
            return [&surface, &material, &store, tables, integral](std::size_t i) {
                const SeenVertex& seen = surface.seen()[i];
                auto found = tables->find(i);
                if (found == tables->end()) {
                    found = tables->emplace(i, hashed(surface.wavelets(), seen.vertex)).first;
                }
                const tripling::FieldPlace place = place_of(material, seen);
                const std::size_t stride = tripling::face_stride(surface.face_resolution());
                std::array<float, 6> scaling{};
                PublishedIntegral::Table mixed;
                for (std::size_t part = 0; part < place.count; ++part) {
                    const auto view = store.view(place.entries[part].index);
                    const float weight = place.entries[part].weight;
                    for (std::size_t face = 0; face < scaling.size(); ++face) {
                        scaling[face] += weight * view.scaling[face];
                        for (std::uint32_t s = view.first[face]; s < view.first[face + 1];
                             ++s) {
                            auto& sum = mixed[static_cast<std::uint32_t>(face * stride +
                                                                         view.squares[s])];
                            for (std::size_t m = 0; m < 3; ++m) {
                                sum[m] += weight * view.values[s][m + 1];
                            }
                        }
                    }
                }
                return integral->integrate(found->second.scaling, found->second.squares,
                                           scaling, mixed);
            };
        }};
}

TripleWay bits_way(const SeenSurface& surface,
                   const TabulatedMaterial& material,
                   const tripling::TexelStore& texels,
                   const TripleLight& light) {
    return {"bits", [&surface, &material, &texels, &light] {
                return [&](std::size_t i) {
                    const SeenVertex& seen = surface.seen()[i];
                    const tripling::FieldPlace place = place_of(material, seen);
                    std::array<engine::WeightedTexels, engine::kMostMixed> parts;
                    for (std::size_t part = 0; part < place.count; ++part) {
                        parts[part] = {.weight = place.entries[part].weight,
                                       .function = texels.view(place.entries[part].index)};
                    }
                    return engine::sum_open_mixture(surface.bits_in_blocks(seen.vertex),
                                                    light.block_planes(),
                                                    std::span(parts).first(place.count));
                };
            }};
}

TripleWay decompressed_way(const SeenSurface& surface,
                           const TabulatedMaterial& material,
                           std::size_t fraction,
                           const TripleLight& light) {
    return {"decompressed", [&surface, &material, fraction, &light] {
                struct Scratch {
                    std::vector<std::array<std::uint32_t, 3>> places;
                    Coefficients visibility, material;
                    std::vector<std::uint64_t> all;
                };
                const std::uint32_t n = surface.face_resolution();
                auto scratch = std::make_shared<Scratch>();
                scratch->places = places_of_squares(n);
                scratch->visibility.resize(basis::texel_count(n));
                scratch->material.resize(basis::texel_count(n));
                scratch->all.assign(basis::texel_count(n) / 64, ~std::uint64_t{0});
                const tripling::WaveletStore& store = material.field(fraction).lobes.front();
                return [&surface, &material, &store, &light, n, scratch](std::size_t i) {
                    const SeenVertex& seen = surface.seen()[i];
                    fill_visibility(n, surface.wavelets().point(seen.vertex), scratch->places,
                                    scratch->visibility);
                    fill_material(n, store, place_of(material, seen), scratch->places,
                                  scratch->material);
                    basis::haar_inverse_cubemap(n, scratch->visibility);
                    basis::haar_inverse_cubemap(n, scratch->material);
                    for (std::size_t t = 0; t < scratch->material.size(); ++t) {
                        scratch->material[t] *= scratch->visibility[t];
                    }
                    return engine::sum_open_products(scratch->all, light.planes(),
                                                     scratch->material.data());
                };
            }};
}

TripleWay pixels_way(const SeenSurface& surface,
                     const TabulatedMaterial& material,
                     const TripleLight& light,
                     std::size_t most) {
    return {"pixels", [&surface, &material, &light, most] {
                struct Memory {
                    std::vector<std::vector<float>> visibility;  // in squares
                    std::unordered_map<std::size_t, std::vector<float>> entries;
                    std::vector<float> product;
                    std::vector<std::uint64_t> all;
                };
                auto memory = std::make_shared<Memory>();
                const std::size_t count = std::min(most, surface.seen().size());
                for (std::size_t i = 0; i < count; ++i) {
                    const SeenVertex& seen = surface.seen()[i];
                    const auto bits = surface.bits_in_blocks(seen.vertex);
                    auto& open = memory->visibility.emplace_back(64 * bits.size());
                    for (std::size_t t = 0; t < open.size(); ++t) {
                        open[t] = static_cast<float>(bits[t / 64] >> t % 64 & 1U);
                    }
                    const tripling::FieldPlace place = place_of(material, seen);
                    for (std::size_t part = 0; part < place.count; ++part) {
                        const std::size_t entry = place.entries[part].index;
                        memory->entries.try_emplace(entry, material.texels().texels(entry));
                    }
                    memory->all.assign(bits.size(), ~std::uint64_t{0});
                    memory->product.resize(open.size());
                }
                return [&surface, &material, &light, memory, count](std::size_t i) {
                    const std::size_t vertex = i % count;
                    const tripling::FieldPlace place =
                        place_of(material, surface.seen()[vertex]);
                    std::vector<float>& product = memory->product;
                    std::fill(product.begin(), product.end(), 0.0F);
                    for (std::size_t part = 0; part < place.count; ++part) {
                        const float weight = place.entries[part].weight;
                        const auto& entry = memory->entries.at(place.entries[part].index);
                        for (std::size_t t = 0; t < entry.size(); ++t) {
                            product[t] += weight * entry[t];
                        }
                    }
                    const std::vector<float>& open = memory->visibility[vertex];
                    for (std::size_t t = 0; t < product.size(); ++t) {
                        product[t] *= open[t];
                    }
                    return engine::sum_open_products(memory->all, light.block_planes(),
                                                     product.data());
                };
            }};
}

}  // namespace relume::lab
