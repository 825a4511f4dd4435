// The dense cells of a group of segments, sorted by block. Compiled once per instruction set,
// as Highway's own "-inl" headers are, for what is handed out on the way is inlined.
#if defined(RELUME_CELL_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELUME_CELL_LISTS_INL_H
#undef RELUME_CELL_LISTS_INL_H
#else
#define RELUME_CELL_LISTS_INL_H
#endif

#include "server/engine/kernels/accumulate.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {

struct ListedCell {
    const std::uint8_t* cell;
    transport::CellTag tag;
    std::uint16_t segment;  // in its group
};

// Segments, at most kMaxSegments, are walked once, in the order of memory, each cell asked for
// a while before it is passed; the blocks' lists then find it in the cache. Cells of strips,
// and the high parts of split ones, are not listed but handed out on the way: most hold so
// little that to list them would cost more than to add them.
template <std::size_t kMaxSegments>
class CellLists {
  public:
    // Replaces what the lists hold by the cells of `count` segments; calls
    // on_strips(segment, block, cell, scale), which returns the end of the cell, the value
    // being scale times what the cell holds.
    template <typename SegmentAt, typename OnStrips>
    HWY_INLINE void fill(std::size_t count,
                         const SegmentAt& segment_at,
                         std::uint32_t block_count,
                         const OnStrips& on_strips) {
        counts_.fill(0);
        for (std::size_t s = 0; s < count; ++s) {
            walk(segment_at(s), static_cast<std::uint16_t>(s), block_count, on_strips);
        }
    }

    // In the order of the segments.
    [[nodiscard]] std::span<const ListedCell> of_block(std::uint32_t block) const {
        return std::span(cells_[block]).first(counts_[block]);
    }

  private:
    static constexpr std::array<float, transport::kMaxParts> kPartScales{1, 256, 65536};
    static constexpr std::uint32_t kTagsPerWord = 16;
    static constexpr std::size_t kCacheLine = 64;
    // The next segment is as a rule the next in memory.
    static constexpr std::size_t kPrefetchBytes = 1024;

    template <typename OnStrips>
    HWY_INLINE void walk(const transport::SegmentView& segment,
                         std::uint16_t number,
                         std::uint32_t block_count,
                         const OnStrips& on_strips) {
        const std::uint8_t* cell = segment.cells;
        const std::uint8_t* ahead = cell;
        for (std::uint32_t first = 0; first < block_count; first += kTagsPerWord) {
            const std::uint32_t count = std::min(kTagsPerWord, block_count - first);
            std::uint64_t tags = 0;
            std::memcpy(&tags, segment.tags + first / 2, transport::tag_bytes(count));
            std::uint64_t present = transport::occupied_tags(tags);
            for (; present != 0; present &= present - 1) {
                const auto bit = static_cast<unsigned>(std::countr_zero(present));
                auto tag = static_cast<transport::CellTag>((tags >> bit) & 0xFU);
                const std::uint32_t block = first + bit / 4;
                for (std::size_t part = transport::upper_parts(tag); part > 0; --part) {
                    cell = on_strips(number, block, cell, kPartScales[part]);
                }
                tag = transport::low_tag(tag);
                if (tag == transport::CellTag::strips8) {
                    cell = on_strips(number, block, cell, 1.0F);
                } else {
                    cells_[block][counts_[block]++] = {cell, tag, number};
                    cell += transport::cell_bytes(tag, cell);
                }
                for (; ahead < cell + kPrefetchBytes; ahead += kCacheLine) {
                    __builtin_prefetch(ahead);
                }
            }
        }
    }

    // Rows a power of two apart would all begin in the same set of the first-level cache.
    static constexpr std::size_t kRowCells = kMaxSegments + kCacheLine / sizeof(ListedCell);
    static_assert(kMaxSegments <= 1U + std::uint16_t(-1));

    std::array<std::array<ListedCell, kRowCells>, transport::kMaxBlocksPerShard> cells_;
    std::array<std::uint32_t, transport::kMaxBlocksPerShard> counts_;
};

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
