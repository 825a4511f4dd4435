#include "server/materials/material_work.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::materials {
namespace {

// How a tile's columns come to a knowledge: from so many samples (TileEstimate), in so many
// parts, of so many tiles together. What is done at once takes two cores some 20 ms of tiles
// that are all of the material, so that other rooms do not wait longer.
struct Stage {
    std::uint32_t samples;
    std::uint32_t parts;
    std::size_t tiles;
};
constexpr std::size_t kGlanceTiles = 8;

constexpr Stage stage_of(Knowledge knowledge) {
    switch (knowledge) {
        case Knowledge::nothing:
        case Knowledge::glance:
            break;
        case Knowledge::draft:
            return {.samples = 2, .parts = 1, .tiles = 8};
        case Knowledge::better:
            return {.samples = 8, .parts = 1, .tiles = 2};
        case Knowledge::whole:
            return {.samples = 64, .parts = 8, .tiles = 2};
    }
    return {.samples = 1, .parts = 1, .tiles = 1};
}

Knowledge next_stage(Knowledge columns) {
    switch (columns) {
        case Knowledge::nothing:
        case Knowledge::glance:
            return Knowledge::draft;
        case Knowledge::draft:
            return Knowledge::better;
        case Knowledge::better:
        case Knowledge::whole:
            break;
    }
    return Knowledge::whole;
}

double squared_length(std::span<const float> values) {
    double sum = 0;
    for (const float value : values) {
        sum += double{value} * double{value};
    }
    return sum;
}

}  // namespace

void KnownErrors::compare(Knowledge before,
                          std::span<const float> shown,
                          std::span<const float> whole) {
    if (shown.size() != whole.size()) {
        return;
    }
    const auto at = static_cast<std::size_t>(before);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const double difference = double{shown[i]} - double{whole[i]};
        difference_[at] += difference * difference;
    }
    whole_[at] += squared_length(whole);
}

void KnownErrors::learn() {
    for (const Knowledge knowledge : {Knowledge::glance, Knowledge::draft, Knowledge::better}) {
        const auto at = static_cast<std::size_t>(knowledge);
        if (whole_[at] > 0) {
            relative_[at] = std::sqrt(difference_[at] / whole_[at]);
        }
        difference_[at] = whole_[at] = 0;
    }
}

MaterialWork::MaterialWork(const EditablePoints& points, ShownMaterial shown)
    : points_(points),
      shown_(std::move(shown)),
      tile_from_number_(points.image().block_count(), -1) {
    for (const std::uint32_t tile : points.materials()[shown_.material].tiles) {
        tile_from_number_[tile] = static_cast<std::int32_t>(tiles_.size());
        tiles_.push_back({.number = tile});
    }
}

void MaterialWork::show(ShownMaterial shown) {
    shown_ = std::move(shown);
    glance_is_of_the_past_ = true;
    for (Tile& tile : tiles_) {
        tile.is_applied = false;
        tile.knowledge = Knowledge::nothing;
    }
    count();
}

void MaterialWork::light_has_changed() {
    glance_is_of_the_past_ = true;
    for (Tile& tile : tiles_) {
        tile.columns.reset();
        tile.is_applied = false;
        tile.columns_are = tile.knowledge = Knowledge::nothing;
    }
    batch_.reset();
    count();
}

void MaterialWork::show_changes_of(const MaterialWork& other) {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        tiles_[i].change = other.tiles_[i].change;
    }
}

// Of a tile that has columns.
void MaterialWork::set_change(Tile& tile) {
    const TileColumns& columns = *tile.columns;
    tile.change.slots.assign(columns.slots().begin(), columns.slots().end());
    tile.change.rgb.resize(3 * columns.slots().size());
    columns.change(shown_.brdf.curves()[shown_.taken_up].curve, shown_.diffuse,
                   tile.change.rgb);
    tile.knowledge = tile.columns_are;
    tile.is_applied = true;
}

void MaterialWork::count() {
    known_ = whole_ = 0;
    for (const Tile& tile : tiles_) {
        known_ += tile.knowledge != Knowledge::nothing ? 1U : 0U;
        whole_ += tile.knowledge == Knowledge::whole ? 1U : 0U;
    }
}

bool MaterialWork::has_columns() const {
    return std::all_of(tiles_.begin(), tiles_.end(),
                       [](const Tile& tile) { return tile.columns != nullptr; });
}

bool MaterialWork::apply_columns() {
    std::vector<Tile*> due;
    for (Tile& tile : tiles_) {
        if (tile.columns && !tile.is_applied) {
            due.push_back(&tile);
        }
    }
    tbb::parallel_for(std::size_t{0}, due.size(), [&](std::size_t i) { set_change(*due[i]); });
    count();
    return !due.empty();
}

bool MaterialWork::glance(const std::shared_ptr<const PresentLight>& light) {
    if (next_glance_ == 0) {
        glance_light_ = light;
        glance_shown_ = std::make_unique<const ShownMaterial>(shown_);
        glance_is_of_the_past_ = false;
    }
    const std::size_t end = std::min(next_glance_ + kGlanceTiles, tiles_.size());
    const TileEstimate estimate(points_, *glance_light_);
    tbb::parallel_for(next_glance_, end, [&](std::size_t i) {
        if (!tiles_[i].columns) {
            tiles_[i].glanced = estimate.glance(*glance_shown_, tiles_[i].number);
        }
    });
    next_glance_ = end;
    if (end < tiles_.size()) {
        return false;
    }
    for (Tile& tile : tiles_) {
        if (tile.columns) {
            continue;
        }
        std::swap(tile.change, tile.glanced);
        tile.knowledge = glance_is_of_the_past_ ? Knowledge::nothing : Knowledge::glance;
    }
    next_glance_ = 0;
    glance_light_.reset();
    count();
    return true;
}

void MaterialWork::begin_batch() {
    const auto is_behind = [](const Tile& a, const Tile& b) {
        return a.columns_are < b.columns_are;
    };
    const Knowledge least =
        std::min_element(tiles_.begin(), tiles_.end(), is_behind)->columns_are;
    batch_.emplace();
    batch_->stage = next_stage(least);
    for (Tile& tile : tiles_) {
        if (tile.columns_are == least && batch_->tiles.size() < stage_of(batch_->stage).tiles) {
            batch_->tiles.push_back(&tile);
        }
    }
    batch_->sums.resize(batch_->tiles.size());
}

void MaterialWork::finish_batch(KnownErrors& errors) {
    std::vector<std::pair<Knowledge, std::vector<float>>> before(batch_->tiles.size());
    tbb::parallel_for(std::size_t{0}, batch_->tiles.size(), [&](std::size_t i) {
        Tile& tile = *batch_->tiles[i];
        ColumnSum& sum = batch_->sums[i];
        before[i] = {tile.knowledge, tile.change.rgb};
        tile.columns =
            std::make_unique<const TileColumns>(std::move(sum.slots), std::move(sum.values));
        tile.columns_are = batch_->stage;
        set_change(tile);
    });
    for (std::size_t i = 0; i < before.size(); ++i) {
        errors.compare(before[i].first, before[i].second, batch_->tiles[i]->change.rgb);
    }
    batch_.reset();
    count();
}

bool MaterialWork::estimate(const PresentLight& light, KnownErrors& errors) {
    if (!batch_) {
        begin_batch();
    }
    const Stage stage = stage_of(batch_->stage);
    const TileEstimate estimate(points_, light);
    tbb::parallel_for(std::size_t{0}, batch_->tiles.size(), [&](std::size_t i) {
        estimate.add_directions(
            shown_, batch_->tiles[i]->number,
            {.samples = stage.samples, .part = batch_->parts_done, .parts = stage.parts},
            batch_->sums[i]);
    });
    if (++batch_->parts_done < stage.parts) {
        return false;
    }
    finish_batch(errors);
    return true;
}

double MaterialWork::squared_error(const KnownErrors& errors) const {
    double sum = 0;
    for (const Tile& tile : tiles_) {
        if (tile.knowledge != Knowledge::whole) {
            const double relative = errors.of(tile.knowledge);
            sum += relative * relative * squared_length(tile.change.rgb);
        }
    }
    return sum;
}

std::size_t MaterialWork::bytes() const {
    std::size_t sum = 0;
    for (const Tile& tile : tiles_) {
        sum += sizeof(Tile) + (tile.columns ? tile.columns->bytes() : 0) +
               (tile.change.rgb.capacity() + tile.glanced.rgb.capacity()) * sizeof(float);
    }
    return sum;
}

const TileChange* MaterialWork::change(std::uint32_t tile) const {
    const std::int32_t at = tile_from_number_[tile];
    return at < 0 ? nullptr : &tiles_[static_cast<std::size_t>(at)].change;
}

}  // namespace relume::materials
