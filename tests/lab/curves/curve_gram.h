// What a change of a curve does to an image, as quadratic forms: enough to compare bases of
// curves without an image for each.
#pragma once

#include "protocol/curve/curve.h"
#include "protocol/transport/transport.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace relume::lab {

// ‖T' δ‖², over the image and one colour, is δᵀ G δ for a change δ of the 256 samples.
struct CurveGram {
    std::array<Eigen::MatrixXd, 3> of_samples;  // 256×256, red, green and blue

    // Σ over colours of δᵀ G δ.
    [[nodiscard]] double squared_norm(const std::array<Eigen::VectorXd, 3>& change) const;
};

// Of the stored transport of one material, before tint. Parallel.
[[nodiscard]] CurveGram curve_gram(const transport::Transport& transport,
                                   std::uint32_t material);

}  // namespace relume::lab
