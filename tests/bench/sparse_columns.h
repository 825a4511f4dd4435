// Chosen columns of a scene as the plainest of all lists: where a value stands and what it is.
// What the peers build their own storage from.
#pragma once

#include "server/engine/columns/column_change.h"
#include "server/scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace relume::bench {

// What the rows of a peer's matrix are.
enum class PeerBasis {
    // One row per pixel, as [Ng03] and whoever has a sparse matrix store the transport.
    pixels,
    // One row per coefficient of a block (block_basis.h): the integers of the engine's own
    // cells. Most of what is not zero by pixel vanishes in them.
    ours,
};
inline constexpr PeerBasis kPeerBases[] = {PeerBasis::pixels, PeerBasis::ours};
[[nodiscard]] std::string_view name_from(PeerBasis basis);

// Of [Ng03 §5], 8 bits: integers of a column, on each side of zero.
inline constexpr float kNg03Levels = 127;

struct SparseEntry {
    std::uint32_t block = 0;   // in the shard
    std::uint32_t slot = 0;    // pixel of the tile, or coefficient of the block
    std::int32_t integer = 0;  // value / scale of the matrix column, to the nearest; not 0
    float value = 0;           // before it was rounded
};

// A matrix of a peer: position j'·K + k is channel k of the j'-th chosen column. Immutable;
// safe to share between threads.
//
// In our basis an entry is an integer of a cell, and the scale is the step. By pixel the cells
// are transformed into the pixels that are covered, before tint, and rounded to `levels` over
// the largest magnitude of the column in the whole image; what is then zero is no entry.
class SparseColumns {
  public:
    SparseColumns(const served::Scene& scene,
                  std::span<const std::uint32_t> columns,
                  PeerBasis basis,
                  float levels = kNg03Levels);

    [[nodiscard]] const served::Scene& scene() const { return *scene_; }
    [[nodiscard]] PeerBasis basis() const { return basis_; }
    [[nodiscard]] std::uint32_t channels() const { return channels_; }
    // Positions, columns × channels.
    [[nodiscard]] std::size_t size() const { return scales_.size(); }
    // Of channel 0. Throws std::out_of_range for a column that was not chosen.
    [[nodiscard]] std::size_t position(std::uint32_t column) const {
        return places_.at(column) * channels_;
    }
    [[nodiscard]] float scale(std::size_t position) const { return scales_[position]; }

    // Calls `visit` for every entry in one shard, ordered by block and slot.
    using VisitEntry = std::function<void(const SparseEntry&)>;
    void for_each_entry(const transport::ShardReader& shard,
                        std::size_t position,
                        const VisitEntry& visit) const;

    // An image of the engine, [blocks][3][256], in this basis: by pixel 0 where none is
    // covered.
    [[nodiscard]] std::vector<float> image_from_sums(std::span<const float> sums) const;

  private:
    using Values = std::array<float, transport::kBlockSize>;
    using VisitBlock = std::function<void(std::uint32_t, const Values&)>;

    // `visit(block in shard, values)`, of blocks that are not empty.
    void for_each_block(const transport::ShardReader& shard,
                        std::size_t position,
                        const VisitBlock& visit) const;
    void keep_covered(std::uint32_t block,
                      std::span<float, transport::kBlockSize> pixels) const;
    [[nodiscard]] float largest_magnitude(std::size_t position) const;

    const served::Scene* scene_;
    PeerBasis basis_;
    std::uint32_t channels_;
    std::vector<std::uint32_t> columns_;
    std::unordered_map<std::uint32_t, std::size_t> places_;  // in columns_
    std::vector<float> scales_;                              // by position
};

// matrix[c][k]·ΔL(j,c): what channel k of a change counts in each colour, before the scale.
[[nodiscard]] std::array<float, transport::kColours> channel_weights(
    const served::Scene& scene, const engine::ColumnChange& change, std::uint32_t channel);

}  // namespace relume::bench
