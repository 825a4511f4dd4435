// The rows of a cluster in a basis over its vertices, quantised as a transport's blocks are.
#pragma once

#include "protocol/transport/shard_writer.h"
#include "tests/lab/cpca/light_weights.h"
#include "tests/lab/cpca/subspace.h"
#include "tests/lab/cpca/vertex_rows.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

// What a block is stored in: transport::BlockBasis::identity or haar_line, or the principal
// components of the cluster's rows, the basis being stored beside them.
enum class ClusterBasis : std::uint8_t { identity, haar_line, learned };

// The step of every coefficient of light, [N], as bake::StepChooser's rule has them:
// min(scale·2^(kStepGrowth·octave), coarsest).
struct StepRule {
    float scale = 0;
    float coarsest = 0;
};
[[nodiscard]] std::vector<float> steps_of_rule(const basis::CubemapBasis& basis,
                                               const StepRule& rule);

// Expected squared errors, or energies, of the receivers, by kind of light.
struct LightSums {
    double natural = 0;
    double sun = 0;

    void add(const LightSums& other) {
        natural += other.natural;
        sun += other.sun;
    }
};

// An orthonormal basis as it is stored: 16 bits a weight and a scale of 32 bits a vector.
// Returns the weights as read again.
[[nodiscard]] Eigen::MatrixXf stored_weights(const Eigen::MatrixXf& weights);
[[nodiscard]] constexpr std::size_t stored_weight_bytes(std::size_t vertices,
                                                        std::size_t vectors) {
    return vectors * (2 * vertices + sizeof(float));
}

// A cluster's coefficients as read from its cells: what each adds up to under some lights.
struct EncodedCluster {
    std::vector<transport::EncodedBlock> blocks;  // one for each term
    std::size_t components = 0;                   // of a learned basis: S
    std::size_t basis_bytes = 0;
    std::vector<double> bytes_of_band;     // of cells
    std::vector<double> nonzeros_of_band;  // values that are not zero
    // [components or 256][planes][lights]: what the stored coefficients answer.
    std::vector<float> answers;
};

class CodedCluster {
  public:
    // `members` share a material and are at most 256; `falloff` weighs columns for the learned
    // basis as 2^(−falloff·octave). Keeps a reference to the rows. Memory: as many values as
    // the members' rows have, or 256 a column.
    CodedCluster(const VertexRows& rows,
                 std::vector<std::uint32_t> members,
                 ClusterBasis basis,
                 float falloff,
                 const LightWeights& lights);

    // How many leading components of a learned basis are worth their bytes at these steps, at
    // most `most`; of the others all are stored.
    [[nodiscard]] std::size_t components(std::span<const float> steps, std::size_t most) const;
    // Of what is then stored, against the rows, as these columns show it.
    [[nodiscard]] LightSums error(std::span<const float> steps,
                                  std::span<const WeighedColumn> columns,
                                  std::size_t most) const;
    [[nodiscard]] const LightSums& energy() const { return energy_; }

    // The leading components, or all where there are fewer. `lights` is [N][count].
    [[nodiscard]] EncodedCluster encode(std::span<const float> steps,
                                        std::size_t most_components,
                                        const RowVectors& lights) const;

    [[nodiscard]] std::span<const std::uint32_t> members() const { return members_; }
    [[nodiscard]] std::uint32_t planes() const { return planes_; }
    // Components of a column, stored or not.
    [[nodiscard]] std::size_t width() const { return width_; }
    // Weights of the learned basis as stored, [members][members]; empty for others.
    [[nodiscard]] const Eigen::MatrixXf& weights() const { return weights_; }
    // By falling energy, of rows weighted by `falloff`; of a learned basis.
    [[nodiscard]] const Eigen::VectorXd& energies() const { return energies_; }
    // From components to vertices, by the order of members(): values is [width], in place.
    void vertices_from_components(std::span<float> values, std::size_t components) const;

  private:
    using Sums = std::array<double, transport::kBlockSize>;
    // By component, at some steps.
    struct ComponentSums {
        Sums natural{};  // squared error of what is stored
        Sums sun{};
        Sums gain{};  // energy less error, in squared steps
        Sums nonzeros{};
    };
    [[nodiscard]] ComponentSums sums(std::span<const float> steps,
                                     std::span<const WeighedColumn> columns) const;
    [[nodiscard]] std::size_t worthwhile(const ComponentSums& sums, std::size_t most) const;
    void learn(float falloff);
    void fill();
    void add_energies();
    // Σ over the constant light's coefficients of what they are off by, squared.
    void add_constant_error(std::span<const float> steps, Sums& natural) const;

    const VertexRows& rows_;
    std::vector<std::uint32_t> members_;
    ClusterBasis basis_;
    const LightWeights& lights_;
    std::uint32_t planes_;
    std::size_t width_;  // components of a column
    Eigen::MatrixXf weights_;
    Eigen::VectorXd energies_;
    std::vector<float> coefficients_;  // [planes][N][width]
    Sums natural_energy_{};
    Sums sun_energy_{};
    LightSums energy_;
};

}  // namespace relume::lab
