// Clustered PCA of a surface's transport [Sloan03, Liu04] against blocks as relume-bake stores
// them, at equal error; and its second step in full and by largest changes.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/blocks/light_model.h"
#include "precompute/scene/scene.h"
#include "tests/lab/cpca/coded_rows.h"
#include "tests/lab/cpca/seams.h"
#include "tests/lab/cpca/second_step.h"
#include "tests/lab/sequences/lighting_sequence.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace relume::lab {

struct CpcaOptions {
    bake::BakeParameters bake;
    std::size_t most_runs = 1;              // of sixteen clusters, of those of the surface
    double error = 0.01;                    // asked of every way of storing, of both lights
    float falloff = bake::kNaturalFalloff;  // by which columns are weighted for the PCA
    std::size_t most_components = transport::kBlockSize;  // S
    std::size_t share = 4;              // the second step adds S over this many changes
    std::size_t sketch_numbers = 2048;  // of a row, while clusters are tried
    LightingSequence sequence;          // of the second step
    Environments environments;
};

// A way of storing the surface, at one error.
struct CodedFigures {
    std::string name;
    LightErrors asked;
    StoredBytes bytes;
    LightErrors expected;  // by the model that chose the steps
    LightErrors measured;  // under the bake's model lights
    std::size_t median_components = 0;
    std::size_t most_components = 0;
    SeamFigures natural_seams;
    SeamFigures sun_seams;
    std::vector<double> bytes_of_band;
    std::vector<double> nonzeros_of_band;
};

struct CpcaFindings {
    std::size_t vertices = 0;  // that have rows
    std::size_t surface_vertices = 0;
    std::size_t clusters = 0;
    std::size_t blocks = 0;
    std::uint32_t channels = 0;
    std::size_t columns = 0;
    LightErrors baked;  // of the bake's own steps
    transport::BlockBasis baked_basis = transport::BlockBasis::haar_line;
    // At options.error, then at the error of the bake's own steps: haar_line, identity, PCA of
    // the bake's clusters, PCA of reassigned ones.
    std::vector<CodedFigures> coded;
    std::vector<double> reassignment_errors;  // as Reassignment's
    // In the median cluster of the bake, of the weighted rows: components that leave 1 %.
    std::size_t median_rank = 0;
    SecondStepFigures second_step;  // of reassigned clusters at options.error

    // As relume-bake stores it, at options.error: haar_line, or identity where it saves
    // bake::StepChooser::kWorthwhile of the bytes.
    [[nodiscard]] const CodedFigures& plain() const;
    // The same at the error of the bake's own steps.
    [[nodiscard]] const CodedFigures& plain_as_baked() const;
    // The one of fewer bytes at options.error.
    [[nodiscard]] const CodedFigures& best_cpca() const;
};

// All but seconds depends on nothing but the arguments, on any number of threads. Memory:
// twelve bytes for each value of the rows. Throws as bake::bake does.
[[nodiscard]] CpcaFindings run_cpca_experiment(const scene::Scene& scene,
                                               const CpcaOptions& options);

}  // namespace relume::lab
