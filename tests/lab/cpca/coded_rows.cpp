#include "tests/lab/cpca/coded_rows.h"

#include "protocol/transport/cell.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace relume::lab {
namespace {

// The largest step that holds, of those from 2^−24 of `high` to all of it.
template <typename Holds>
float largest_within(float high, Holds holds) {
    constexpr int kHalvings = 11;
    if (holds(high)) {
        return high;
    }
    float low = high * 0x1p-24F;
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = std::sqrt(low * high);
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace

StoredBytes shard_bytes(std::span<const transport::EncodedBlock> blocks) {
    const std::size_t segments = blocks.front().segment_count();
    StoredBytes bytes{.heads = (segments + 1) * sizeof(std::uint32_t)};
    for (std::size_t segment = 0; segment < segments; ++segment) {
        bool is_empty = true;
        for (const transport::EncodedBlock& block : blocks) {
            bytes.cells += block.cell(segment).size();
            is_empty = is_empty && block.tag(segment) == transport::CellTag::empty;
        }
        if (!is_empty) {
            bytes.heads += transport::tag_bytes(static_cast<std::uint32_t>(blocks.size()));
        }
    }
    return bytes;
}

CodedRows::CodedRows(const VertexRows& rows,
                     const std::vector<std::vector<std::uint32_t>>& clusters,
                     const LightWeights& lights,
                     const Options& options)
    : rows_(rows), lights_(lights), options_(options) {
    std::vector<std::optional<CodedCluster>> coded(clusters.size());
    tbb::parallel_for(std::size_t{0}, clusters.size(), [&](std::size_t c) {
        if (!clusters[c].empty()) {
            coded[c].emplace(rows, clusters[c], options.basis, options.falloff, lights);
        }
    });
    for (auto& cluster : coded) {
        if (cluster) {
            clusters_.push_back(*std::move(cluster));
        }
    }
    for (const float value : rows.values) {
        largest_step_ = std::max(largest_step_, std::abs(value));
    }
    // No component is larger than all values of its column.
    largest_step_ *= std::sqrt(static_cast<float>(transport::kBlockSize));
}

LightErrors CodedRows::error_of(std::span<const float> steps,
                                std::span<const WeighedColumn> columns) const {
    std::vector<LightSums> errors(clusters_.size());
    tbb::parallel_for(std::size_t{0}, clusters_.size(), [&](std::size_t c) {
        errors[c] = clusters_[c].error(steps, columns, options_.most_components);
    });
    LightSums error;
    LightSums energy;
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
        error.add(errors[c]);
        energy.add(clusters_[c].energy());
    }
    return {.natural = energy.natural > 0 ? std::sqrt(error.natural / energy.natural) : 0,
            .sun = energy.sun > 0 ? std::sqrt(error.sun / energy.sun) : 0};
}

StepRule CodedRows::rule_for(const LightErrors& errors) const {
    StepRule rule{.scale = largest_step_, .coarsest = largest_step_};
    rule.scale = largest_within(largest_step_, [&](float scale) {
        return error_of(steps_of_rule(rows_.basis, {scale, largest_step_}), lights_.some)
                   .natural <= errors.natural;
    });
    rule.coarsest = largest_within(largest_step_, [&](float coarsest) {
        return error_of(steps_of_rule(rows_.basis, {rule.scale, coarsest}), lights_.some).sun <=
               errors.sun;
    });
    return rule;
}

void CodedRows::answer_vertices(std::size_t cluster,
                                std::size_t lights,
                                StoredRows& stored) const {
    const CodedCluster& coded = clusters_[cluster];
    const std::vector<float>& answers = stored.component_answers[cluster];
    const std::size_t values = coded.planes() * lights;
    std::vector<float> column(coded.width());
    for (std::size_t value = 0; value < values; ++value) {
        for (std::size_t i = 0; i < column.size(); ++i) {
            column[i] = answers[i * values + value];
        }
        coded.vertices_from_components(column, stored.components[cluster]);
        for (std::size_t i = 0; i < coded.members().size(); ++i) {
            stored.answers[rows_.first[coded.members()[i]] * lights + value] = column[i];
        }
    }
}

StoredRows CodedRows::store(std::span<const float> steps, const RowVectors& lights) const {
    const auto light_count = static_cast<std::size_t>(lights.cols());
    StoredRows stored{.bytes = {},
                      .expected = error(steps),
                      .components = std::vector<std::size_t>(clusters_.size()),
                      .bytes_of_band = std::vector<double>(rows_.basis.band_count()),
                      .nonzeros_of_band = std::vector<double>(rows_.basis.band_count()),
                      .component_answers = std::vector<std::vector<float>>(clusters_.size()),
                      .answers = std::vector<float>(rows_.first.back() * light_count)};
    std::vector<transport::EncodedBlock> shard;
    const auto close_shard = [&] {
        const StoredBytes bytes = shard_bytes(shard);
        stored.bytes.cells += bytes.cells;
        stored.bytes.heads += bytes.heads;
        shard.clear();
    };
    for (std::size_t first = 0; first < clusters_.size(); first += rows_.clusters_per_shard) {
        const std::size_t count = std::min(rows_.clusters_per_shard, clusters_.size() - first);
        std::vector<std::optional<EncodedCluster>> encoded(count);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            const CodedCluster& cluster = clusters_[first + i];
            encoded[i] = cluster.encode(
                steps, cluster.components(steps, options_.most_components), lights);
        });
        for (std::size_t i = 0; i < count; ++i) {
            EncodedCluster& one = *encoded[i];
            if (!shard.empty() &&
                shard.size() + one.blocks.size() > transport::kMaxBlocksPerShard) {
                close_shard();
            }
            std::move(one.blocks.begin(), one.blocks.end(), std::back_inserter(shard));
            stored.components[first + i] = one.components;
            stored.bytes.bases += one.basis_bytes;
            for (std::size_t band = 0; band < stored.bytes_of_band.size(); ++band) {
                stored.bytes_of_band[band] += one.bytes_of_band[band];
                stored.nonzeros_of_band[band] += one.nonzeros_of_band[band];
            }
            stored.component_answers[first + i] = std::move(one.answers);
        }
        close_shard();
    }
    tbb::parallel_for(std::size_t{0}, clusters_.size(),
                      [&](std::size_t c) { answer_vertices(c, light_count, stored); });
    return stored;
}

}  // namespace relume::lab
