#include "tests/lab/triple/kept_products.h"

#include "protocol/base/timing/stopwatch.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/tripling/texel_blocks.h"
#include "server/engine/kernels/open_mixture.h"
#include "tests/lab/triple/triple_experiment.h"
#include "tests/lab/triple/turning_light.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace relume::lab {
namespace {

using Radiances = std::vector<engine::Radiance>;

// The runs of a material's entries that make a seen vertex's own.
struct Mixture {
    std::array<engine::WeightedTexels, engine::kMostMixed> parts;
    std::size_t count = 0;

    Mixture(const TabulatedMaterial& material, const SeenVertex& seen) {
        const tripling::FieldPlace place =
            tripling::place_in_field(material.field(0), seen.normal, seen.reflection);
        count = place.count;
        for (std::size_t i = 0; i < count; ++i) {
            parts[i] = {.weight = place.entries[i].weight,
                        .function = material.runs().view(place.entries[i].index)};
        }
    }
    [[nodiscard]] std::span<const engine::WeightedTexels> functions() const {
        return std::span(parts).first(count);
    }
};

// V·ρ̃ of a vertex, in squares.
void fill_product(std::span<const std::uint64_t> open,
                  const Mixture& mixture,
                  std::vector<float>& texels) {
    texels.assign(64 * open.size(), 0.0F);
    for (std::size_t run = 0; run < open.size(); ++run) {
        for (const engine::WeightedTexels& part : mixture.functions()) {
            const float* of_run =
                open[run] == 0 ? nullptr : tripling::values_of_run(part.function, run);
            if (of_run != nullptr) {
                for (std::size_t i = 0; i < tripling::kRunTexels; ++i) {
                    texels[64 * run + i] += part.weight * of_run[i];
                }
            }
        }
        for (std::uint64_t shut = ~open[run]; shut != 0; shut &= shut - 1) {
            texels[64 * run + static_cast<std::size_t>(std::countr_zero(shut))] = 0;
        }
    }
}

double milliseconds_of(const std::function<void()>& make) {
    double least = 1e30;
    for (int round = 0; round < 3; ++round) {
        const timing::Stopwatch watch;
        make();
        least = std::min(least, 1e3 * watch.seconds());
    }
    return least;
}

KeptFigures keep_texels(const SeenSurface& surface,
                        const TabulatedMaterial& material,
                        const TripleLight& light,
                        const Radiances& exact) {
    const std::size_t count = surface.seen().size();
    constexpr std::size_t kRun = 256;
    KeptFigures figures;
    const timing::Stopwatch watch;
    tripling::TexelStore store(surface.face_resolution());
    std::vector<std::vector<float>> run(kRun);
    for (std::size_t first = 0; first < count; first += kRun) {
        const std::size_t of_run = std::min(kRun, count - first);
        tbb::parallel_for(std::size_t{0}, of_run, [&](std::size_t i) {
            const SeenVertex& seen = surface.seen()[first + i];
            fill_product(surface.bits_in_blocks(seen.vertex), Mixture(material, seen), run[i]);
        });
        for (std::size_t i = 0; i < of_run; ++i) {
            store.append(run[i], 0);
        }
    }
    figures.fill_seconds = watch.seconds();
    figures.bytes_per_vertex =
        static_cast<double>(store.byte_count()) / static_cast<double>(count);
    Radiances radiance(count);
    figures.milliseconds = milliseconds_of([&] {
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            const std::array one{
                engine::WeightedTexels{.weight = 1, .function = store.view(i)}};
            radiance[i] = engine::sum_open_mixture(
                surface.bits_in_blocks(surface.seen()[i].vertex), light.block_planes(), one);
        });
    });
    figures.error = relative_l2(radiance, exact);
    return figures;
}

KeptFigures keep_lit(const SeenSurface& surface,
                     const TabulatedMaterial& material,
                     const TripleLight& light,
                     const Radiances& exact) {
    const std::size_t seen_count = surface.seen().size();
    const std::size_t count = std::min(kMostLit, seen_count);
    const auto scale = static_cast<double>(seen_count) / static_cast<double>(count);
    const auto place = [&](std::size_t i) { return i * seen_count / count; };
    KeptFigures figures;
    std::vector<std::array<std::vector<float>, 3>> lit(count);
    const timing::Stopwatch watch;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const auto open = surface.bits_in_blocks(surface.seen()[place(i)].vertex);
        for (std::size_t c = 0; c < lit[i].size(); ++c) {
            const float* plane = light.block_planes()[c];
            lit[i][c].resize(64 * open.size());
            for (std::size_t texel = 0; texel < lit[i][c].size(); ++texel) {
                const bool is_open = ((open[texel / 64] >> (texel % 64)) & 1U) != 0;
                lit[i][c][texel] = is_open ? plane[texel] : 0.0F;
            }
        }
    });
    figures.fill_seconds = scale * watch.seconds();
    std::size_t open_runs = 0;
    Radiances truth(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto open = surface.bits_in_blocks(surface.seen()[place(i)].vertex);
        open_runs += static_cast<std::size_t>(std::count_if(
            open.begin(), open.end(), [](std::uint64_t word) { return word != 0; }));
        truth[i] = exact[place(i)];
    }
    figures.bytes_per_vertex =
        static_cast<double>(open_runs * tripling::kRunTexels * 3 * sizeof(float)) /
        static_cast<double>(count);
    Radiances radiance(count);
    figures.milliseconds = scale * milliseconds_of([&] {
                               tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
                                   const SeenVertex& seen = surface.seen()[place(i)];
                                   radiance[i] = engine::sum_open_mixture(
                                       surface.bits_in_blocks(seen.vertex),
                                       {lit[i][0].data(), lit[i][1].data(), lit[i][2].data()},
                                       Mixture(material, seen).functions());
                               });
                           });
    figures.error = relative_l2(radiance, truth);
    return figures;
}

// V·ρ̃ of all seen vertices by wavelets.
class Columns {
  public:
    struct Value {
        std::uint32_t vertex = 0;
        float value = 0;
    };

    Columns(const SeenSurface& surface, const TabulatedMaterial& material)
        : first_(basis::texel_count(surface.face_resolution()) + 1, 0) {
        const std::uint32_t n = surface.face_resolution();
        std::vector<std::vector<Value>> rows(surface.seen().size());  // .vertex: the column
        tbb::enumerable_thread_specific<std::pair<std::vector<float>, std::vector<float>>> work;
        tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
            const SeenVertex& seen = surface.seen()[i];
            auto& [blocks, texels] = work.local();
            fill_product(surface.bits_in_blocks(seen.vertex), Mixture(material, seen), blocks);
            texels.resize(basis::texel_count(n));
            for (std::size_t texel = 0; texel < texels.size(); ++texel) {
                texels[texel] = blocks[tripling::place_in_blocks(n, texel)];
            }
            basis::haar_forward_cubemap(n, texels);
            const float length = std::sqrt(
                std::inner_product(texels.begin(), texels.end(), texels.begin(), 0.0F));
            for (std::uint32_t j = 0; j < texels.size(); ++j) {
                if (std::abs(texels[j]) > kLeftOut * length) {
                    rows[i].push_back({j, texels[j]});
                }
            }
        });
        for (const auto& row : rows) {
            for (const Value& value : row) {
                ++first_[value.vertex + 1];
            }
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        values_.resize(first_.back());
        std::vector<std::size_t> next = first_;
        for (std::uint32_t i = 0; i < rows.size(); ++i) {
            for (const Value& value : rows[i]) {
                values_[next[value.vertex]++] = {i, value.value};
            }
        }
        for (std::size_t j = 0; j + 1 < first_.size(); ++j) {
            double energy = 0;
            for (const Value& value : of(j)) {
                energy += double{value.value} * double{value.value};
            }
            lengths_.push_back(static_cast<float>(std::sqrt(energy)));
        }
    }

    [[nodiscard]] std::size_t count() const { return lengths_.size(); }
    [[nodiscard]] std::size_t byte_count() const { return values_.size() * sizeof(Value); }
    [[nodiscard]] float length(std::size_t column) const { return lengths_[column]; }
    [[nodiscard]] std::span<const Value> of(std::size_t column) const {
        return std::span(values_).subspan(first_[column], first_[column + 1] - first_[column]);
    }
    // Adds changes of these columns to the radiances, each thread to a part of the vertices.
    void add(std::span<const std::uint32_t> columns,
             std::span<const engine::Radiance> changes,
             Radiances& radiance) const {
        constexpr std::size_t kPart = 2048;
        const std::size_t parts = (radiance.size() + kPart - 1) / kPart;
        tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
            const auto first = static_cast<std::uint32_t>(part * kPart);
            const auto end = static_cast<std::uint32_t>(first + kPart);
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const auto values = of(columns[i]);
                auto at = std::lower_bound(values.begin(), values.end(), first,
                                           [](const Value& value, std::uint32_t vertex) {
                                               return value.vertex < vertex;
                                           });
                for (; at != values.end() && at->vertex < end; ++at) {
                    engine::Radiance& sum = radiance[at->vertex];
                    for (std::size_t c = 0; c < sum.size(); ++c) {
                        sum[c] += changes[i][c] * at->value;
                    }
                }
            }
        });
    }

  private:
    std::vector<std::size_t> first_;  // of each column
    std::vector<Value> values_;
    std::vector<float> lengths_;
};

// BI over the columns [Overbeck06].
class Follower {
  public:
    explicit Follower(const Columns& columns, std::size_t vertices)
        : columns_(columns), shown_(columns.count()), radiance_(vertices) {}

    // The `most` coefficients whose change shows most.
    void follow(const TripleLight& light, std::size_t most) {
        std::vector<std::pair<float, std::uint32_t>> changes;
        for (std::uint32_t j = 0; j < shown_.size(); ++j) {
            float change = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                change += std::abs(light.coefficients()[c][j] - shown_[j][c]);
            }
            if (change > 0) {
                changes.emplace_back(change * columns_.length(j), j);
            }
        }
        if (changes.size() > most) {
            std::nth_element(changes.begin(),
                             changes.begin() + static_cast<std::ptrdiff_t>(most), changes.end(),
                             std::greater<>());
            changes.resize(most);
        }
        std::vector<std::uint32_t> columns;
        Radiances by;
        for (const auto& [benefit, j] : changes) {
            columns.push_back(j);
            engine::Radiance change{};
            for (std::size_t c = 0; c < change.size(); ++c) {
                change[c] = light.coefficients()[c][j] - shown_[j][c];
                shown_[j][c] = light.coefficients()[c][j];
            }
            by.push_back(change);
        }
        columns_.add(columns, by, radiance_);
    }
    [[nodiscard]] const Radiances& radiance() const { return radiance_; }

  private:
    const Columns& columns_;
    Radiances shown_;  // coefficients
    Radiances radiance_;
};

std::array<std::vector<float>, 3> copied(const std::array<std::span<const float>, 3>& planes) {
    std::array<std::vector<float>, 3> copy;
    for (std::size_t c = 0; c < copy.size(); ++c) {
        copy[c].assign(planes[c].begin(), planes[c].end());
    }
    return copy;
}

}  // namespace

KeptProducts measure_kept_products(const SeenSurface& surface,
                                   const TabulatedMaterial& material,
                                   const std::string& environment,
                                   std::uint32_t images) {
    const std::uint32_t n = surface.face_resolution();
    TurningLight turning(environment, n);
    const auto light_of = [&](std::uint32_t image) {
        return TripleLight(n, copied(turning.turned(image)));
    };
    const TripleLight first = light_of(0);
    KeptProducts found;
    const TripleWay bits = bits_way(surface, material, material.runs(), first);
    const Radiances exact = integrate_all(surface, bits);
    found.bits_milliseconds = milliseconds_of([&] { (void)integrate_all(surface, bits); });
    found.texels = keep_texels(surface, material, first, exact);
    found.lit = keep_lit(surface, material, first, exact);

    const timing::Stopwatch watch;
    const Columns columns(surface, material);
    found.columns.fill_seconds = watch.seconds();
    found.columns.bytes_per_vertex =
        static_cast<double>(columns.byte_count()) / static_cast<double>(surface.seen().size());
    Follower whole(columns, surface.seen().size());
    const timing::Stopwatch product;
    whole.follow(first, columns.count());
    found.columns.milliseconds = 1e3 * product.seconds();
    found.columns.error = relative_l2(whole.radiance(), exact);
    for (const std::uint32_t coefficients : {30U, 100U, 300U, 1000U}) {
        Follower follower = whole;
        FollowedLight figures{.coefficients = coefficients};
        for (std::uint32_t image = 1; image < images; ++image) {
            const TripleLight light = light_of(image);
            const timing::Stopwatch one;
            follower.follow(light, coefficients);
            figures.milliseconds += 1e3 * one.seconds() / (images - 1);
            const Radiances truth =
                integrate_all(surface, bits_way(surface, material, material.runs(), light));
            figures.error += relative_l2(follower.radiance(), truth) / (images - 1);
        }
        found.followed.push_back(figures);
    }
    return found;
}

}  // namespace relume::lab
