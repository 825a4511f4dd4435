// Rows in few numbers, so that clusters can be tried quickly.
#pragma once

#include "tests/lab/cpca/subspace.h"
#include "tests/lab/cpca/vertex_rows.h"

#include <cstddef>
#include <cstdint>

namespace relume::lab {

// [V][numbers]: every value of a row, times 2^(−falloff·octave) of its column, is added to one
// number with one sign [Charikar02]. The same for all rows, and so linear: what lies in a
// subspace still does, and distances from subspaces of far fewer dimensions than numbers are
// kept within some per cent. Each vertex is added in its own thread.
[[nodiscard]] RowVectors sketch_rows(const VertexRows& rows,
                                     float falloff,
                                     std::size_t numbers,
                                     std::uint64_t seed);

}  // namespace relume::lab
