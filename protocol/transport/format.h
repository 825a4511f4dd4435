// Constants of the transport directory; the normative text is protocol/README.md §2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::transport {

inline constexpr std::uint32_t kFormatVersion = 2;

inline constexpr std::uint32_t kTileSide = 16;
inline constexpr std::uint32_t kBlockSize = kTileSide * kTileSide;  // receivers (slots)
inline constexpr std::uint32_t kMaxBlocksPerShard = 64;
inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint32_t kMaxChannels = 3;
inline constexpr std::uint32_t kColours = 3;
inline constexpr std::uint32_t kMaxTerms = 16;  // of a vertex
inline constexpr std::uint32_t kMinSketchRows = 16;
inline constexpr std::uint32_t kMaxSketchRows = 1024;

inline constexpr std::array<std::uint8_t, 8> kShardMagic{'R', 'E', 'L', 'U',
                                                         'M', 'E', 'S', 'H'};
inline constexpr std::size_t kShardHeaderBytes = 128;
inline constexpr std::size_t kShardAlignment = 64;
// Zeroes after the data, so that vector loads may run past the last cell.
inline constexpr std::size_t kShardTailBytes = 64;

// How a cell (256 values of one column) is stored: all of it, or those of its strips of eight
// slots in which anything is. In the last four, values beyond 8 bits are split into parts of
// 8 bits, q = Σ_i 256^i·part_i with up to two upper ones: first the strips of upper parts, the
// highest first, then the lowest parts of all values.
enum class CellTag : std::uint8_t {
    empty = 0,
    dense8 = 1,
    strips8 = 2,
    dense16 = 3,
    dense32f = 4,
    split_dense8 = 5,
    split_strips8 = 6,
    split3_dense8 = 7,
    split3_strips8 = 8,
};
inline constexpr std::size_t kCellTagCount = 9;
inline constexpr std::array<const char*, kCellTagCount> kCellTagNames{
    "empty",        "dense8",        "strips8",       "dense16",       "dense32f",
    "split_dense8", "split_strips8", "split3_dense8", "split3_strips8"};
inline constexpr std::size_t kMaxParts = 3;
inline constexpr std::int32_t kPartBase = 256;

// How many upper parts a cell is stored with, and how its lowest parts are stored.
[[nodiscard]] constexpr std::size_t upper_parts(CellTag tag) {
    if (tag < CellTag::split_dense8) {
        return 0;
    }
    return tag < CellTag::split3_dense8 ? 1 : 2;
}
[[nodiscard]] constexpr CellTag low_tag(CellTag tag) {
    switch (tag) {
        case CellTag::split_dense8:
        case CellTag::split3_dense8:
            return CellTag::dense8;
        case CellTag::split_strips8:
        case CellTag::split3_strips8:
            return CellTag::strips8;
        default:
            return tag;
    }
}
inline constexpr std::size_t kStripSlots = 8;
inline constexpr std::size_t kStripsPerBlock = kBlockSize / kStripSlots;

}  // namespace relume::transport
