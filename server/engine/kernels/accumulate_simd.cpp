// The accumulation kernel for every instruction set Highway knows, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/engine/kernels/accumulate_simd.cpp"
#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/target.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

// Must come after highway.h, in a group of their own so that no formatter sorts them.
#include "server/engine/kernels/bitmap_expansion-inl.h"
#include "server/engine/kernels/cell_lists-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relume::engine::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // no fused multiply-add: the specification does

void accumulate(std::span<const WeightedSegment> segments,
                std::uint32_t block_count,
                const SumTargets& targets) {
    accumulate_segments_scalar(segments, block_count, targets);
}

#else

namespace {

namespace hn = hwy::HWY_NAMESPACE;
using transport::CellTag;
using transport::kBlockSize;
using transport::kColours;

constexpr std::size_t kSumsPerBlock = kColours * kBlockSize;

// Values that are summed together, each run with its weights.
template <typename Value>
struct CellValues {
    std::array<const Value*, kMaxGroupSegments> values;
    std::array<const float*, kMaxGroupSegments> weights;
    std::size_t count = 0;

    // Nothing is added but a pointer that the next addition overwrites, if not `wanted`.
    void add(const Value* run, const ColourWeights& run_weights, bool wanted = true) {
        values[count] = run;
        weights[count] = run_weights.data();
        count += wanted ? 1 : 0;
    }
};

template <typename D>
HWY_INLINE void add_one(D df, hn::Vec<D> sum, float* HWY_RESTRICT target) {
    hn::StoreU(hn::Add(hn::LoadU(df, target), sum), df, target);
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const std::int8_t* values) {
    const hn::Rebind<std::int32_t, D> d32;
    const hn::Rebind<std::int8_t, D> d8;
    return hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d8, values)));
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const std::int16_t* values) {
    const hn::Rebind<std::int32_t, D> d32;
    const hn::Rebind<std::int16_t, D> d16;
    return hn::ConvertTo(df, hn::PromoteTo(d32, hn::LoadU(d16, values)));
}

template <typename D>
HWY_INLINE hn::Vec<D> load_values(D df, const float* values) {
    return hn::LoadU(df, values);
}

// A few vectors of slots in three colours, summed in registers: as many as there are registers
// for.
template <typename D>
struct Registers {
#if HWY_TARGET == HWY_AVX3
    static constexpr std::size_t kVectors = 4;
#else
    static constexpr std::size_t kVectors = 2;
#endif
    hn::Vec<D> red[kVectors], green[kVectors], blue[kVectors];

    HWY_INLINE void clear(D df) {
        for (std::size_t v = 0; v < kVectors; ++v) {
            red[v] = green[v] = blue[v] = hn::Zero(df);
        }
    }

    HWY_INLINE void load(D df, const float* HWY_RESTRICT sums) {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            red[v] = hn::LoadU(df, sums);
            green[v] = hn::LoadU(df, sums + kBlockSize);
            blue[v] = hn::LoadU(df, sums + 2 * kBlockSize);
        }
    }

    HWY_INLINE void store(D df, float* HWY_RESTRICT sums) const {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            hn::StoreU(red[v], df, sums);
            hn::StoreU(green[v], df, sums + kBlockSize);
            hn::StoreU(blue[v], df, sums + 2 * kBlockSize);
        }
    }

    template <typename Value>
    HWY_INLINE void add(D df, const CellValues<Value>& cells, std::size_t slot) {
        for (std::size_t s = 0; s < cells.count; ++s) {
            const Value* HWY_RESTRICT values = cells.values[s] + slot;
            const float* HWY_RESTRICT weights = cells.weights[s];
            const auto r = hn::Set(df, weights[0]);
            const auto g = hn::Set(df, weights[1]);
            const auto b = hn::Set(df, weights[2]);
            for (std::size_t v = 0; v < kVectors; ++v) {
                const auto value = load_values(df, values + v * hn::Lanes(df));
                red[v] = hn::MulAdd(r, value, red[v]);
                green[v] = hn::MulAdd(g, value, green[v]);
                blue[v] = hn::MulAdd(b, value, blue[v]);
            }
        }
    }

    HWY_INLINE void add_to(D df, float* HWY_RESTRICT sums) const {
        for (std::size_t v = 0; v < kVectors; ++v, sums += hn::Lanes(df)) {
            add_one(df, red[v], sums);
            add_one(df, green[v], sums + kBlockSize);
            add_one(df, blue[v], sums + 2 * kBlockSize);
        }
    }
};

// The cells of one block that are summed together; 8-bit ones by quarters, so that those that
// hold only zeroes, as the finest of a block's coefficients often do, cost nothing.
class BlockValues {
  public:
    static constexpr std::size_t kQuarters = 4;
    static constexpr std::size_t kQuarterSlots = kBlockSize / kQuarters;

    std::array<CellValues<std::int8_t>, kQuarters> bits8;
    CellValues<std::int16_t> bits16;
    CellValues<float> floats;

    void clear() {
        for (auto& quarter : bits8) {
            quarter.count = 0;
        }
        bits16.count = floats.count = 0;
    }

    // Sums pass through registers once for all cells.
    void add_to(float* HWY_RESTRICT sums, float* HWY_RESTRICT total) const {
        const hn::CappedTag<float, 16> df;
        for_each_part([&](auto& registers, std::size_t slot) HWY_ATTR {
            registers.clear(df);
            add_part(registers, slot);
            registers.add_to(df, sums + slot);
            if (total != nullptr) {
                registers.add_to(df, total + slot);
            }
        });
    }

    // The sums so far, [3][256], go on.
    void go_on(float* HWY_RESTRICT sums) const {
        const hn::CappedTag<float, 16> df;
        for_each_part([&](auto& registers, std::size_t slot) HWY_ATTR {
            registers.load(df, sums + slot);
            add_part(registers, slot);
            registers.store(df, sums + slot);
        });
    }

  private:
    using BlockRegisters = Registers<hn::CappedTag<float, 16>>;

    template <typename Part>
    HWY_INLINE void for_each_part(const Part& part) const {
        const hn::CappedTag<float, 16> df;
        BlockRegisters registers;
        const std::size_t slots = BlockRegisters::kVectors * hn::Lanes(df);
        for (std::size_t slot = 0; slot < kBlockSize; slot += slots) {
            if (bits8[slot / kQuarterSlots].count + bits16.count + floats.count != 0) {
                part(registers, slot);
            }
        }
    }

    HWY_INLINE void add_part(BlockRegisters& registers, std::size_t slot) const {
        const hn::CappedTag<float, 16> df;
        registers.add(df, bits8[slot / kQuarterSlots], slot % kQuarterSlots);
        registers.add(df, bits16, slot);
        registers.add(df, floats, slot);
    }
};

// What a block's cells add up to group after group, [3][256], until there are no more.
class GroupSums {
  public:
    void clear() { used_ = 0; }

    void add(std::uint32_t block, const BlockValues& values) {
        if (((used_ >> block) & 1U) == 0) {
            used_ |= std::uint64_t{1} << block;
            sums_[block].fill(0);
        }
        values.go_on(sums_[block].data());
    }

    void add_to(const SumTargets& targets) const {
        const hn::CappedTag<float, 16> df;
        for (std::uint64_t left = used_; left != 0; left &= left - 1) {
            const auto block = static_cast<std::size_t>(std::countr_zero(left));
            for (std::size_t i = 0; i < kSumsPerBlock; i += hn::Lanes(df)) {
                const auto sum = hn::LoadU(df, &sums_[block][i]);
                add_one(df, sum, targets.sums + block * kSumsPerBlock + i);
                if (targets.total != nullptr) {
                    add_one(df, sum, targets.total + block * kSumsPerBlock + i);
                }
            }
        }
    }

  private:
    alignas(
        64) std::array<std::array<float, kSumsPerBlock>, transport::kMaxBlocksPerShard> sums_;
    std::uint64_t used_ = 0;
};

// What sparse cells add up to, colours side by side so that a value is one addition; by block,
// zero until the block's first sparse cell.
class SparseSums {
  public:
    void clear() { used_ = 0; }

    HWY_INLINE void add(std::uint32_t block,
                        const std::uint8_t* cell,
                        const ColourWeights& weights,
                        float scale) {
        const hn::FixedTag<float, 4> d4;
        float* HWY_RESTRICT sums = sums_[block].data();
        if (((used_ >> block) & 1U) == 0) {
            used_ |= std::uint64_t{1} << block;
            sums_[block].fill(0);
        }
        const std::array<float, 4> padded{weights[0], weights[1], weights[2], 0};
        const auto w = hn::Mul(hn::Set(d4, scale), hn::LoadU(d4, padded.data()));
        const std::size_t count = cell[0];
        const std::uint8_t* slots = cell + 1;
        const auto* values = reinterpret_cast<const std::int8_t*>(slots + count);
        for (std::size_t i = 0; i < count; ++i) {
            float* slot = sums + std::size_t{4} * slots[i];
            const auto value = hn::Set(d4, static_cast<float>(values[i]));
            hn::Store(hn::MulAdd(w, value, hn::Load(d4, slot)), d4, slot);
        }
    }

    void add_to(const SumTargets& targets) const {
        for (std::uint64_t left = used_; left != 0; left &= left - 1) {
            const auto block = static_cast<std::size_t>(std::countr_zero(left));
            add_block(sums_[block].data(), targets.sums + block * kSumsPerBlock);
            if (targets.total != nullptr) {
                add_block(sums_[block].data(), targets.total + block * kSumsPerBlock);
            }
        }
    }

  private:
    static void add_block(const float* HWY_RESTRICT sums, float* HWY_RESTRICT target) {
        const hn::FixedTag<float, 4> d4;
        for (std::size_t slot = 0; slot < kBlockSize; slot += 4) {
            hn::Vec<decltype(d4)> red, green, blue, unused;
            hn::LoadInterleaved4(d4, sums + 4 * slot, red, green, blue, unused);
            add_one(d4, red, target + slot);
            add_one(d4, green, target + kBlockSize + slot);
            add_one(d4, blue, target + 2 * kBlockSize + slot);
        }
    }

    alignas(
        64) std::array<std::array<float, 4 * kBlockSize>, transport::kMaxBlocksPerShard> sums_;
    std::uint64_t used_ = 0;
};
static_assert(transport::kMaxBlocksPerShard <= 64);

// What a thread keeps from call to call; too large for its stack.
class Workspace {
  public:
    void accumulate(std::span<const WeightedSegment> segments,
                    std::uint32_t block_count,
                    const SumTargets& targets) {
        sparse_.clear();
        groups_.clear();
        const bool only_one_group = next_group(segments).size() == segments.size();
        while (!segments.empty()) {
            const auto group = next_group(segments);
            lists_.fill(
                group.size(), [&](std::size_t s) { return group[s].segment; }, block_count,
                [&](std::size_t s, std::uint32_t block, const std::uint8_t* cell, float scale)
                    HWY_ATTR { sparse_.add(block, cell, group[s].weights, scale); });
            for (std::uint32_t block = 0; block < block_count; ++block) {
                if (lists_.of_block(block).empty()) {
                    continue;
                }
                take_cells(group, block);
                if (only_one_group) {
                    const std::size_t first = std::size_t{block} * kSumsPerBlock;
                    values_.add_to(targets.sums + first,
                                   targets.total != nullptr ? targets.total + first : nullptr);
                } else {
                    groups_.add(block, values_);
                }
            }
            segments = segments.subspan(group.size());
        }
        groups_.add_to(targets);
        sparse_.add_to(targets);
    }

  private:
    void take_cells(std::span<const WeightedSegment> group, std::uint32_t block) {
        values_.clear();
        std::size_t expanded8 = 0;
        for (const ListedCell& listed : lists_.of_block(block)) {
            const ColourWeights& weights = group[listed.segment].weights;
            const std::uint8_t* cell = listed.cell;
            switch (listed.tag) {
                case CellTag::dense8:
                    for (std::size_t q = 0; q < BlockValues::kQuarters; ++q) {
                        values_.bits8[q].add(reinterpret_cast<const std::int8_t*>(cell) +
                                                 q * BlockValues::kQuarterSlots,
                                             weights);
                    }
                    break;
                case CellTag::bitmap8: {
                    const std::int8_t* values = expanded8_[expanded8].data();
                    expansion_.bits8(cell, expanded8_[expanded8++].data());
                    for (std::size_t q = 0; q < BlockValues::kQuarters; ++q) {
                        std::uint64_t occupied = 0;
                        std::memcpy(&occupied, cell + q * sizeof(occupied), sizeof(occupied));
                        values_.bits8[q].add(values + q * BlockValues::kQuarterSlots, weights,
                                             occupied != 0);
                    }
                    break;
                }
                case CellTag::dense16: {
                    std::int16_t* values = expanded16_[values_.bits16.count].data();
                    std::memcpy(values, cell, kBlockSize * sizeof(std::int16_t));
                    values_.bits16.add(values, weights);
                    break;
                }
                case CellTag::bitmap16: {
                    std::int16_t* values = expanded16_[values_.bits16.count].data();
                    expansion_.bits16(cell, values);
                    values_.bits16.add(values, weights);
                    break;
                }
                case CellTag::dense32f: {
                    transport::DecodedCell& values = decoded_[values_.floats.count];
                    transport::decode_cell(listed.tag, cell, values);
                    values_.floats.add(values.data(), weights);
                    break;
                }
                default:  // lists hold no others
                    break;
            }
        }
    }

    const BitmapExpansion expansion_ = best_expansion();
    CellLists<kMaxGroupSegments> lists_;
    BlockValues values_;
    GroupSums groups_;
    SparseSums sparse_;
    // In the order in which they go into values_.
    std::array<std::array<std::int8_t, kBlockSize>, kMaxGroupSegments> expanded8_;
    std::array<std::array<std::int16_t, kBlockSize>, kMaxGroupSegments> expanded16_;
    std::array<transport::DecodedCell, kMaxGroupSegments> decoded_;
};

}  // namespace

void accumulate(std::span<const WeightedSegment> segments,
                std::uint32_t block_count,
                const SumTargets& targets) {
    // On the heap: the address of a thread's own object would be asked for in every loop.
    thread_local const auto workspace = std::make_unique<Workspace>();
    workspace->accumulate(segments, block_count, targets);
}

#endif  // HWY_SCALAR

}  // namespace relume::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::engine {

HWY_EXPORT(accumulate);

void accumulate_segments(std::span<const WeightedSegment> segments,
                         std::uint32_t block_count,
                         const SumTargets& targets) {
    static const bool scalar = scalar_is_forced();
    if (scalar) {
        accumulate_segments_scalar(segments, block_count, targets);
        return;
    }
    apply_forced_target();
    HWY_DYNAMIC_DISPATCH(accumulate)(segments, block_count, targets);
}

}  // namespace relume::engine
#endif
