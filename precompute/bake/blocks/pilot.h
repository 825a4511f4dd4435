// A look at a few blocks before the bake: how many channels the transport needs, and how finely
// each column is to be quantised (step_chooser.h).
#pragma once

#include "precompute/bake/blocks/row_source.h"
#include "protocol/transport/manifest.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

struct Quantisation {
    transport::ColourModel colour;
    std::vector<float> steps;    // [N][K]
    double chroma_residual = 0;  // relative L2 of what one channel would lose
};

// `bits` as in the parameters; `seed` chooses the blocks. Deterministic, on any number of
// threads.
[[nodiscard]] Quantisation plan_quantisation(const RowSource& rows,
                                             std::uint32_t bits,
                                             std::uint64_t seed);

}  // namespace relume::bake
