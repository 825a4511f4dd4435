#include "tests/lab/triple/peers.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"
#include "server/engine/kernels/open_mixture.h"
#include "server/engine/kernels/open_texels.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <unordered_map>
#include <utility>

namespace relume::lab {
namespace {

tripling::FieldPlace place_of(const TabulatedMaterial& material, const SeenVertex& seen) {
    return tripling::place_in_field(material.field(0), seen.normal, seen.reflection);
}

// Where the coefficients of the squares of a face are among those of haar.h.
std::vector<std::array<std::uint32_t, 3>> places_of_squares(std::uint32_t n) {
    std::vector<std::array<std::uint32_t, 3>> places(tripling::square_count(n));
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t m = 0; m < 3; ++m) {
            places[i][m] = static_cast<std::uint32_t>(tripling::coefficient_from_wavelet(
                n, tripling::square_from_index(i), tripling::kWaveletTypes[m]));
        }
    }
    return places;
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

// [Ng04 §5.3] with the hash tables of [Ng04 §7.1.1], for red, green and blue at a time.
class PublishedIntegral {
  public:
    using Square = std::array<float, 3>;
    using Table = std::unordered_map<std::uint32_t, Square>;

    PublishedIntegral(const TripleLight& light, const tripling::SquareSet& terms)
        : light_(light), n_(light.face_resolution()), places_(places_of_squares(n_)) {
        terms.for_each([&](std::size_t square) {
            light_terms_.push_back(static_cast<std::uint32_t>(square));
        });
    }

    engine::Radiance integrate(const std::array<float, 6>& visible_scaling,
                               const Table& visibility,
                               const std::array<float, 6>& material_scaling,
                               const Table& material) {
        visibility_ = &visibility;
        material_ = &material;
        visible_scaling_ = visible_scaling;
        material_scaling_ = material_scaling;
        visible_sums_.clear();
        material_sums_.clear();
        light_sums_.clear();
        engine::Radiance sum{};
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += visible_scaling[face] * material_scaling[face] *
                          light_.coefficients()[c][face * n_ * n_] / static_cast<float>(n_);
            }
        }
        for (const auto& [square, p] : material) {
            add_material(square, p, sum);
        }
        for (const std::uint32_t square : light_terms_) {
            const auto found = visibility.find(square);
            if (found == visibility.end()) {
                continue;
            }
            const float mean = parent_sum(material, material_scaling_, material_sums_, square);
            for (std::size_t c = 0; c < 3; ++c) {
                const Square l = light_square(c, square);
                for (std::size_t m = 0; m < 3; ++m) {
                    sum[c] += found->second[m] * l[m] * mean;
                }
            }
        }
        return sum;
    }

  private:
    using Sums = std::unordered_map<std::uint32_t, float>;

    [[nodiscard]] std::size_t within(std::uint32_t square) const {
        return square % tripling::face_stride(n_);
    }
    [[nodiscard]] std::size_t face(std::uint32_t square) const {
        return square / tripling::face_stride(n_);
    }
    [[nodiscard]] Square light_square(std::size_t colour, std::uint32_t square) const {
        const auto& places = places_[within(square)];
        const float* of_face = &light_.coefficients()[colour][face(square) * n_ * n_];
        return {of_face[places[0]], of_face[places[1]], of_face[places[2]]};
    }
    // Value over the square of all coarser functions, remembered.
    float parent_sum(const Table& table,
                     const std::array<float, 6>& scaling,
                     Sums& known,
                     std::uint32_t square) {
        const auto found = known.find(square);
        if (found != known.end()) {
            return found->second;
        }
        const std::size_t in_face = within(square);
        float sum = 0;
        if (in_face == 0) {
            sum = scaling[face(square)] / static_cast<float>(n_);
        } else {
            const auto parent =
                static_cast<std::uint32_t>(square - in_face + tripling::parent_square(in_face));
            sum = parent_sum(table, scaling, known, parent);
            const auto values = table.find(parent);
            if (values != table.end()) {
                sum += signed_sum(in_face, values->second);
            }
        }
        known.emplace(square, sum);
        return sum;
    }
    [[nodiscard]] float signed_sum(std::size_t in_face, const Square& of_parent) const {
        const std::size_t parent = tripling::parent_square(in_face);
        const auto& signs = tripling::kQuadrantSigns[tripling::quadrant_in_parent(in_face)];
        float sum = 0;
        for (std::size_t m = 0; m < 3; ++m) {
            sum += static_cast<float>(signs[m]) * of_parent[m];
        }
        return sum *
               static_cast<float>(tripling::amplitude(n_, tripling::level_from_square(parent)));
    }
    Square light_parent_sum(std::uint32_t square) {
        const auto found = light_sums_.find(square);
        if (found != light_sums_.end()) {
            return found->second;
        }
        const std::size_t in_face = within(square);
        Square sum{};
        if (in_face == 0) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] =
                    light_.coefficients()[c][face(square) * n_ * n_] / static_cast<float>(n_);
            }
        } else {
            const auto parent =
                static_cast<std::uint32_t>(square - in_face + tripling::parent_square(in_face));
            sum = light_parent_sum(parent);
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += signed_sum(in_face, light_square(c, parent));
            }
        }
        light_sums_.emplace(square, sum);
        return sum;
    }
    void add_material(std::uint32_t square, const Square& p, engine::Radiance& sum) {
        const auto found = visibility_->find(square);
        const Square v = found == visibility_->end() ? Square{} : found->second;
        const float visible = parent_sum(*visibility_, visible_scaling_, visible_sums_, square);
        const Square of_light = light_parent_sum(square);
        const auto size = static_cast<float>(
            tripling::amplitude(n_, tripling::level_from_square(within(square))));
        for (std::size_t c = 0; c < 3; ++c) {
            const Square l = light_square(c, square);
            sum[c] += size *
                      (p[0] * (l[1] * v[2] + l[2] * v[1]) + p[1] * (l[2] * v[0] + l[0] * v[2]) +
                       p[2] * (l[0] * v[1] + l[1] * v[0]));
            for (std::size_t m = 0; m < 3; ++m) {
                sum[c] += p[m] * (l[m] * visible + v[m] * of_light[c]);
            }
        }
    }

    const TripleLight& light_;
    std::uint32_t n_;
    std::vector<std::array<std::uint32_t, 3>> places_;
    std::vector<std::uint32_t> light_terms_;
    const Table* visibility_ = nullptr;
    const Table* material_ = nullptr;
    std::array<float, 6> visible_scaling_{};
    std::array<float, 6> material_scaling_{};
    Sums visible_sums_;
    Sums material_sums_;
    std::unordered_map<std::uint32_t, Square> light_sums_;
};

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

TripleLight::TripleLight(std::uint32_t face_resolution,
                         std::array<std::vector<float>, 3> texels)
    : n_(face_resolution), texels_(std::move(texels)), table_(face_resolution) {
    constexpr std::array<float, 3> kWeights{0.2126F, 0.7152F, 0.0722F};
    luminance_.assign(texels_[0].size(), 0.0F);
    for (std::size_t c = 0; c < 3; ++c) {
        block_texels_[c] = tripling::values_in_blocks(n_, texels_[c]);
        coefficients_[c] = texels_[c];
        basis::haar_forward_cubemap(n_, coefficients_[c]);
        for (std::size_t i = 0; i < luminance_.size(); ++i) {
            luminance_[i] += kWeights[c] * coefficients_[c][i];
        }
        texels_[c].resize(block_texels_[c].size(), 0.0F);
    }
    table_.set({coefficients_[0], coefficients_[1], coefficients_[2]});
}

engine::ColourPlanes TripleLight::block_planes() const {
    return {block_texels_[0].data(), block_texels_[1].data(), block_texels_[2].data()};
}

engine::ColourPlanes TripleLight::planes() const {
    return {texels_[0].data(), texels_[1].data(), texels_[2].data()};
}

tripling::SquareSet TripleLight::largest(double fraction) const {
    return tripling::largest_squares(n_, luminance_, terms_of_fraction(n_, fraction),
                                     tripling::TermOrder::by_area);
}

TripleWay sublinear_way(const SeenSurface& surface,
                        const TabulatedMaterial& material,
                        std::size_t fraction,
                        const TripleLight& light,
                        const tripling::SquareSet& light_terms) {
    return {"sublinear", [&surface, &material, fraction, &light, &light_terms] {
                auto workspace =
                    std::make_shared<engine::TripleWorkspace>(surface.face_resolution());
                const tripling::WaveletStore& store = material.field(fraction).lobes.front();
                return [&surface, &material, &store, &light, &light_terms,
                        workspace](std::size_t i) {
                    const SeenVertex& seen = surface.seen()[i];
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
