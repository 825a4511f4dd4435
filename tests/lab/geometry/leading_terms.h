// A surface's transport with fewer terms.
#pragma once

#include "protocol/transport/transport.h"

#include <cstdint>
#include <memory>

namespace relume::lab {

// The same vertices, steps and cells, of the first `terms` terms of every material alone; of
// materials that have fewer, all; without what vertices see of the light. Where a material is factored by SVD its terms are in the
// order of their singular values, and the first ones are the best sum of so many
// (precompute/factors). Throws std::invalid_argument unless `of` is of kind mesh and `terms` is
// at least 1.
[[nodiscard]] std::shared_ptr<const transport::Transport> leading_terms(
    const transport::Transport& of, std::uint32_t terms);

}  // namespace relume::lab
