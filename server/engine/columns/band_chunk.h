// Neighbouring columns of one band: the unit that loops over a signal are parallel over.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::engine {

// Places [first, last) in ColumnTable::by_band, all of one band.
struct BandChunk {
    std::uint32_t band = 0;
    std::size_t first = 0;
    std::size_t last = 0;
};

}  // namespace relume::engine
