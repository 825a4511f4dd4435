// A look at a few blocks before the bake: how many channels the transport needs, and how finely
// each column is to be quantised (step_chooser.h).
#pragma once

#include "precompute/bake/receivers/receivers.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "protocol/transport/manifest.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

struct Quantisation {
    transport::ColourModel colour;
    std::vector<float> steps;    // [N][K]
    double chroma_residual = 0;  // relative L2 of what one channel would lose
};

// Deterministic, on any number of threads.
[[nodiscard]] Quantisation plan_quantisation(const RowBaker& rows,
                                             const Receivers& receivers,
                                             const PathTracer& tracer,
                                             const BakeParameters& parameters);

}  // namespace relume::bake
