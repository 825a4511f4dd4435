// From the answers of a cluster's components to its vertices, U = W·P: all of it, or its
// largest changes [Overbeck06T §7.3].
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

// One cluster of n vertices with S components. The components are orthonormal, so that the
// length of a component's change is how much it changes the vertices.
class SecondStep {
  public:
    // `weights` is [n][S]. All is zero at first.
    SecondStep(const Eigen::MatrixXf& weights, std::size_t planes);

    // `answers` is [S][planes].
    void compute_all(std::span<const float> answers);
    // Adds the changes of the `count` components that changed most since they were added.
    void add_largest(std::span<const float> answers, std::size_t count);

    // [planes][n].
    [[nodiscard]] std::span<const float> vertices() const { return vertices_; }
    [[nodiscard]] std::size_t components() const { return components_; }

  private:
    void add(std::size_t component, std::span<const float> change);

    std::size_t count_;  // n
    std::size_t components_;
    std::size_t planes_;
    std::vector<float> weights_;  // [S][n]
    std::vector<float> shown_;    // [S][planes], as added
    std::vector<float> vertices_;
    struct Change {
        float energy = 0;
        std::uint32_t component = 0;
    };
    std::vector<Change> changes_;
    std::vector<float> change_;
};

// A cluster while the light moves.
struct DraggedCluster {
    const Eigen::MatrixXf* weights = nullptr;  // [n][≥ S]
    std::size_t components = 0;                // S
    std::size_t planes = 0;
    std::span<const float> answers;  // [S][planes][lights]
};

struct SecondStepFigures {
    double full_seconds = 0;  // processor time of one thread, the least of several runs
    double incremental_seconds = 0;
    double added_error = 0;  // relative L2, in the mean over images, of the moving ones
    double worst_error = 0;  // of an image

    [[nodiscard]] double gain() const { return full_seconds / incremental_seconds; }
};

// Over lights [first_light, first_light + images), of which the first is computed in full.
// `share` is 4 where a quarter of the components is added in each image, at least one.
[[nodiscard]] SecondStepFigures measure_second_step(std::span<const DraggedCluster> clusters,
                                                    std::size_t lights,
                                                    std::size_t first_light,
                                                    std::size_t images,
                                                    std::size_t share);

}  // namespace relume::lab
