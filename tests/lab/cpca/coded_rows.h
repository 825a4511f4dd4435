// All clusters of a surface in bases of one kind: the steps that keep to an error, and the
// bytes that these cost.
#pragma once

#include "tests/lab/cpca/coded_cluster.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace relume::lab {

// Relative L2 errors of the terms of all vertices, each vertex counting alike.
struct LightErrors {
    double natural = 0;
    double sun = 0;
};

// Of the shards' cells, their heads (tags and index), and learned bases.
struct StoredBytes {
    std::size_t cells = 0;
    std::size_t heads = 0;
    std::size_t bases = 0;

    [[nodiscard]] std::size_t total() const { return cells + heads + bases; }
};

// A surface's rows as stored at some steps.
struct StoredRows {
    StoredBytes bytes;
    LightErrors expected;                 // of the error model
    std::vector<std::size_t> components;  // of every cluster
    std::vector<double> bytes_of_band;    // of cells
    std::vector<double> nonzeros_of_band;
    // [components or 256][planes][lights] of every cluster, and what becomes of them:
    // by vertex, [planes][lights].
    std::vector<std::vector<float>> component_answers;
    std::vector<float> answers;
};

class CodedRows {
  public:
    struct Options {
        ClusterBasis basis = ClusterBasis::haar_line;
        float falloff = 0;  // as CodedCluster's
        std::size_t most_components = std::numeric_limits<std::size_t>::max();
    };

    // Keeps references to rows and weights.
    CodedRows(const VertexRows& rows,
              const std::vector<std::vector<std::uint32_t>>& clusters,
              const LightWeights& lights,
              const Options& options);

    [[nodiscard]] LightErrors error(std::span<const float> steps) const {
        return error_of(steps, lights_.all);
    }
    // The largest steps whose errors are at most these, found as the bake finds its own: first
    // the scale, by natural light, then the coarsest step, by the sun. Some columns stand for
    // all.
    [[nodiscard]] StepRule rule_for(const LightErrors& errors) const;
    // `lights` is [N][count].
    [[nodiscard]] StoredRows store(std::span<const float> steps,
                                   const RowVectors& lights) const;

    [[nodiscard]] std::span<const CodedCluster> clusters() const { return clusters_; }

  private:
    [[nodiscard]] LightErrors error_of(std::span<const float> steps,
                                       std::span<const WeighedColumn> columns) const;
    void answer_vertices(std::size_t cluster, std::size_t lights, StoredRows& stored) const;

    const VertexRows& rows_;
    const LightWeights& lights_;
    Options options_;
    std::vector<CodedCluster> clusters_;
    float largest_step_ = 0;
};

// Index and data of a shard of these blocks, as transport::write_shard writes them.
[[nodiscard]] StoredBytes shard_bytes(std::span<const transport::EncodedBlock> blocks);

}  // namespace relume::lab
