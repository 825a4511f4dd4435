#include "tests/lab/cpca/reassignment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace relume::lab {
namespace {

constexpr double kLeastGain = 1e-3;  // of the error, in a round
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Members = std::vector<std::vector<std::uint32_t>>;

// How far a vertex is from the subspace of a cluster.
struct Distance {
    std::uint32_t cluster = 0;
    double squared = 0;
};

struct Move {
    std::uint32_t vertex = 0;
    std::uint32_t target = 0;
    double gain = 0;
};

class Clusters {
  public:
    Clusters(const RowVectors& vectors,
             const VertexGraph& graph,
             std::span<const std::uint32_t> cluster_of,
             std::size_t clusters,
             const ReassignmentOptions& options)
        : vectors_(vectors),
          graph_(graph),
          cluster_of_(cluster_of.begin(), cluster_of.end()),
          options_(options),
          subspaces_(clusters) {
        members_ = members_of(cluster_of_, clusters);
        tbb::parallel_for(std::size_t{0}, clusters, [&](std::size_t c) {
            subspaces_[c] = principal_subspace(vectors_, members_[c], options_.axes);
        });
    }

    [[nodiscard]] double error() const {
        double sum = 0;
        for (const Subspace& subspace : subspaces_) {
            sum += subspace.missed;
        }
        return sum;
    }
    [[nodiscard]] std::vector<std::uint32_t> take_cluster_of() {
        return std::move(cluster_of_);
    }

    void improve() {
        measure_distances();
        for (const Move& move : moves()) {
            make(move);
        }
        members_ = members_of(cluster_of_, subspaces_.size());
        tbb::parallel_for(std::size_t{0}, subspaces_.size(), [&](std::size_t c) {
            Subspace found = principal_subspace(vectors_, members_[c], options_.axes);
            Subspace& own = subspaces_[c];
            own.missed = 0;
            for (const std::uint32_t v : members_[c]) {
                own.missed += own.squared_distance(vectors_.row(v));
            }
            if (found.missed < own.missed) {
                own = std::move(found);
            }
        });
    }

  private:
    void measure_distances() {
        std::vector<std::set<std::uint32_t>> beside(subspaces_.size());
        for (std::size_t v = 0; v < cluster_of_.size(); ++v) {
            beside[cluster_of_[v]].insert(cluster_of_[v]);
            for (std::uint32_t i = graph_.first[v]; i < graph_.first[v + 1]; ++i) {
                beside[cluster_of_[v]].insert(cluster_of_[graph_.neighbours[i]]);
            }
        }
        distances_.assign(cluster_of_.size(), {});
        tbb::parallel_for(std::size_t{0}, cluster_of_.size(), [&](std::size_t v) {
            for (const std::uint32_t c : beside[cluster_of_[v]]) {
                distances_[v].push_back({.cluster = c,
                                         .squared = subspaces_[c].squared_distance(
                                             vectors_.row(static_cast<Eigen::Index>(v)))});
            }
        });
    }

    // What the vertex gains by moving from its cluster to another; a large loss where that is
    // not beside its own.
    [[nodiscard]] double gain(std::uint32_t vertex, std::uint32_t target) const {
        double here = 0;
        double there = std::numeric_limits<double>::infinity();
        for (const Distance& distance : distances_[vertex]) {
            if (distance.cluster == cluster_of_[vertex]) {
                here = distance.squared;
            }
            if (distance.cluster == target) {
                there = distance.squared;
            }
        }
        return here - there;
    }

    // Each vertex's to where it gains most, by falling gain.
    [[nodiscard]] std::vector<Move> moves() {
        std::vector<Move> all;
        for (std::uint32_t v = 0; v < cluster_of_.size(); ++v) {
            for (const Distance& distance : distances_[v]) {
                if (const double gained = gain(v, distance.cluster); gained > 0) {
                    all.push_back({.vertex = v, .target = distance.cluster, .gain = gained});
                }
            }
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const Move& a, const Move& b) { return a.gain > b.gain; });
        moved_.assign(cluster_of_.size(), false);
        return all;
    }

    void make(const Move& move) {
        if (moved_[move.vertex]) {
            return;
        }
        const std::uint32_t source = cluster_of_[move.vertex];
        std::uint32_t exchanged = kNone;
        if (members_[move.target].size() >= options_.capacity) {
            double best = -move.gain;
            for (const std::uint32_t other : members_[move.target]) {
                if (!moved_[other] && gain(other, source) > best) {
                    best = gain(other, source);
                    exchanged = other;
                }
            }
            if (exchanged == kNone) {
                return;
            }
            put(exchanged, source);
        }
        put(move.vertex, move.target);
    }
    void put(std::uint32_t vertex, std::uint32_t target) {
        std::erase(members_[cluster_of_[vertex]], vertex);
        members_[target].push_back(vertex);
        cluster_of_[vertex] = target;
        moved_[vertex] = true;
    }

    const RowVectors& vectors_;
    const VertexGraph& graph_;
    std::vector<std::uint32_t> cluster_of_;
    ReassignmentOptions options_;
    std::vector<Subspace> subspaces_;
    Members members_;
    std::vector<std::vector<Distance>> distances_;
    std::vector<bool> moved_;  // in this round
};

}  // namespace

std::vector<std::vector<std::uint32_t>> members_of(std::span<const std::uint32_t> cluster_of,
                                                   std::size_t clusters) {
    Members members(clusters);
    for (std::uint32_t v = 0; v < cluster_of.size(); ++v) {
        members[cluster_of[v]].push_back(v);
    }
    return members;
}

Reassignment reassign(const RowVectors& vectors,
                      const VertexGraph& graph,
                      std::span<const std::uint32_t> cluster_of,
                      std::size_t clusters,
                      const ReassignmentOptions& options) {
    Clusters state(vectors, graph, cluster_of, clusters, options);
    Reassignment result;
    result.errors.push_back(state.error());
    for (std::size_t round = 0; round < options.most_rounds; ++round) {
        state.improve();
        result.errors.push_back(state.error());
        if (result.errors.back() > (1 - kLeastGain) * result.errors[round]) {
            break;
        }
    }
    result.cluster_of = state.take_cluster_of();
    return result;
}

}  // namespace relume::lab
