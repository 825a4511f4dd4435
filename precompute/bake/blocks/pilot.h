// A look at a few blocks before the bake: how many channels the transport needs, in which basis
// its blocks are shortest, and how finely each column is to be quantised (step_chooser.h).
#pragma once

#include "precompute/bake/blocks/row_source.h"
#include "precompute/bake/blocks/step_chooser.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/manifest.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

struct Quantisation {
    transport::ColourModel colour;
    transport::BlockBasis block_basis = transport::BlockBasis::haar_tile;
    std::vector<float> steps;    // [N][K]
    double chroma_residual = 0;  // relative L2 of what one channel would lose
    // What the blocks looked at take in each of the bases, if there are several.
    std::vector<BytesOfBasis> bytes_of_basis;
};

// `bits` as in the parameters; `seed` chooses the blocks. Deterministic, on any number of
// threads.
[[nodiscard]] Quantisation plan_quantisation(const RowSource& rows,
                                             std::uint32_t bits,
                                             std::uint64_t seed);

}  // namespace relume::bake
