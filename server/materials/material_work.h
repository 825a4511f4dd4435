// One edited material of a room: by how much its pixels differ from the bake's, and the columns
// that say so for any curve.
#pragma once

#include "server/materials/tile_estimate.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relume::materials {

// How a tile's change is known. Each is better than those before.
enum class Knowledge : std::uint8_t {
    nothing,  // none, or that of another light or another edit
    glance,   // TileEstimate::glance
    draft,    // columns of few directions
    better,   // of four times as many
    whole     // of all directions
};
inline constexpr std::size_t kKnowledges = 5;

// How far changes of each kind have been from those of columns of more directions, as a part of
// these. Learned as columns become better; a guess before.
class KnownErrors {
  public:
    [[nodiscard]] double of(Knowledge knowledge) const {
        return relative_[static_cast<std::size_t>(knowledge)];
    }
    void compare(Knowledge before, std::span<const float> shown, std::span<const float> whole);
    // Takes over what was compared since the last time.
    void learn();

  private:
    std::array<double, kKnowledges> relative_{1, 0.5, 0.2, 0.1, 0};
    std::array<double, kKnowledges> difference_{};  // squared, so far
    std::array<double, kKnowledges> whole_{};
};

// Not thread-safe.
class MaterialWork {
  public:
    // Keeps a reference to the points.
    MaterialWork(const EditablePoints& points, ShownMaterial shown);

    [[nodiscard]] const ShownMaterial& shown() const { return shown_; }
    // Shows another curve or colour of columns that stay (ShownMaterial::has_columns_of).
    void show(ShownMaterial shown);
    // Shows, until there is better, what another one of the same material shows.
    void show_changes_of(const MaterialWork& other);
    // The light is another: columns are lost, and what is shown stays until there is better.
    void light_has_changed();

    // Brings what is shown of tiles that have columns up to date. True where any was not.
    bool apply_columns();
    // Whether every tile shows at least a glance of what is asked for.
    [[nodiscard]] bool is_known() const { return known_ == tiles_.size(); }
    // Whether every tile has columns, so that a curve can be dragged.
    [[nodiscard]] bool has_columns() const;
    [[nodiscard]] bool is_whole() const { return whole_ == tiles_.size(); }
    [[nodiscard]] std::size_t tiles_to_come() const { return tiles_.size() - whole_; }

    // One glance at all tiles, shown at once when it is whole, whatever has changed meanwhile:
    // under a light that moves all the time something is shown.
    [[nodiscard]] bool is_glancing() const { return next_glance_ > 0; }
    // Takes a batch of tiles further; true where what is shown has changed. Expects that not
    // all is known.
    bool glance(const std::shared_ptr<const PresentLight>& light);
    // Estimates columns of a batch of tiles, or a part of them: drafts first. True where what
    // is shown has changed. Expects that not all is whole.
    bool estimate(const PresentLight& light, KnownErrors& errors);

    // Squared length of what is shown, times the squared error that it is known with.
    [[nodiscard]] double squared_error(const KnownErrors& errors) const;
    [[nodiscard]] std::size_t bytes() const;
    // Of the tile; none where it has none of the material.
    [[nodiscard]] const TileChange* change(std::uint32_t tile) const;

  private:
    struct Tile {
        std::uint32_t number = 0;
        Knowledge knowledge = Knowledge::nothing;  // of `change`
        bool is_applied = false;                   // of columns
        std::unique_ptr<const TileColumns> columns{};
        Knowledge columns_are = Knowledge::nothing;
        TileChange change{};
        TileChange glanced{};  // of a glance that is not whole
    };

    // Tiles whose columns get more directions together.
    struct Batch {
        Knowledge stage = Knowledge::draft;  // that they come to
        std::vector<Tile*> tiles;
        std::vector<ColumnSum> sums;
        std::uint32_t parts_done = 0;
    };

    void set_change(Tile& tile);
    void begin_batch();
    void finish_batch(KnownErrors& errors);
    void count();

    const EditablePoints& points_;
    ShownMaterial shown_;
    std::vector<Tile> tiles_;
    std::vector<std::int32_t> tile_from_number_;  // of the image; -1: none
    std::size_t known_ = 0;
    std::size_t whole_ = 0;
    std::optional<Batch> batch_;
    // Of the glance that is going on:
    std::size_t next_glance_ = 0;
    std::shared_ptr<const PresentLight> glance_light_;
    std::unique_ptr<const ShownMaterial> glance_shown_;
    bool glance_is_of_the_past_ = false;
};

}  // namespace relume::materials
