// From red, green and blue to a tint per receiver and the channels that are stored.
#pragma once

#include "precompute/bake/rows/row_baker.h"
#include "protocol/transport/manifest.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <vector>

namespace relume::bake {

// One channel under any tint; or the mean and two differences, whose matrix has orthogonal
// columns, so that errors of the channels do not add up in a colour.
[[nodiscard]] transport::ColourModel grey_model();
[[nodiscard]] transport::ColourModel luma_chroma_model();

struct ChannelRow {
    Imath::V3f tint{1, 1, 1};                   // mean 1
    std::array<std::vector<float>, 3> channel;  // as many as the model has
};

// The inverse of T(c, j) = tint(c) · Σ_k matrix(c, k) · channel(k, j).
//
// The tint is the colour of the receiver's response to white light; with three channels that of
// the direct part, which holds the fine detail: chroma then needs the few coarse coefficients
// of interreflection alone.
void split_colours(const transport::ColourModel& model,
                   const CoefficientRow& row,
                   ChannelRow& channels);

// Σ_c,j (T − tint · grey)² and Σ T²: what one channel would lose.
struct ChromaResidual {
    double residual = 0;
    double energy = 0;

    void add(const ChromaResidual& other, double weight = 1) {
        residual += weight * other.residual;
        energy += weight * other.energy;
    }
};
[[nodiscard]] ChromaResidual chroma_residual(const CoefficientRow& row);

}  // namespace relume::bake
