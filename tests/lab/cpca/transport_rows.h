// The rows of a surface as a transport stores them.
#pragma once

#include "protocol/transport/transport.h"
#include "tests/lab/cpca/vertex_rows.h"

namespace relume::lab {

// All vertices, in the transport's order and clusters. Memory: four bytes a value. Parallel.
// Throws std::invalid_argument unless the transport is of kind mesh.
[[nodiscard]] VertexRows rows_of_transport(const transport::Transport& transport);

}  // namespace relume::lab
