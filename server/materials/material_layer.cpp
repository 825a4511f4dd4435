#include "server/materials/material_layer.h"

#include "protocol/base/timing/stopwatch.h"
#include "protocol/transport/format.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::materials {
namespace {

std::size_t bytes_of(std::span<const std::unique_ptr<MaterialWork>> works) {
    std::size_t sum = 0;
    for (const auto& work : works) {
        sum += work->bytes();
    }
    return sum;
}

// Removes a work with these columns; null where there is none.
std::unique_ptr<MaterialWork> take_columns(std::vector<std::unique_ptr<MaterialWork>>& works,
                                           const ShownMaterial& shown) {
    for (auto& work : works) {
        if (work && work->shown().has_columns_of(shown)) {
            return std::move(work);
        }
    }
    return nullptr;
}

}  // namespace

MaterialLayer::MaterialLayer(std::shared_ptr<const EditablePoints> points,
                             std::size_t most_bytes)
    : points_(std::move(points)), most_bytes_(most_bytes) {}

void MaterialLayer::set_light(const light::LightCubemap& cubemap) {
    light_ = std::make_shared<const PresentLight>(cubemap);
    kept_.clear();
    for (const auto& work : shown_) {
        work->light_has_changed();
    }
    awaits_first_look_ = false;
}

std::unique_ptr<MaterialWork> MaterialLayer::work_for(ShownMaterial shown, Works& before) {
    std::unique_ptr<MaterialWork> work = take_columns(before, shown);
    if (!work) {
        work = take_columns(kept_, shown);
    }
    if (work) {
        if (!(work->shown() == shown)) {
            work->show(std::move(shown));
        }
        return work;
    }
    const std::size_t material = shown.material;
    work = std::make_unique<MaterialWork>(*points_, std::move(shown));
    for (const auto& other : before) {
        if (other && other->shown().material == material) {
            work->show_changes_of(*other);
        }
    }
    return work;
}

void MaterialLayer::set_shown(std::vector<ShownMaterial> shown) {
    Works before = std::move(shown_);
    shown_.clear();
    for (ShownMaterial& one : shown) {
        shown_.push_back(work_for(std::move(one), before));
        awaits_first_look_ = awaits_first_look_ || !shown_.back()->is_known();
    }
    std::erase(kept_, nullptr);
    for (auto& work : before) {
        if (work) {
            kept_.push_back(std::move(work));
        }
    }
    forget_what_does_not_fit();
}

void MaterialLayer::forget_what_does_not_fit() {
    while (!kept_.empty() && bytes() > most_bytes_) {
        kept_.erase(kept_.begin());
    }
}

bool MaterialLayer::may_grow() const {
    return bytes_of(shown_) < most_bytes_;
}

bool MaterialLayer::has_work() const {
    if (!light_) {
        return false;
    }
    const bool all_known = std::all_of(shown_.begin(), shown_.end(),
                                       [](const auto& work) { return work->is_known(); });
    return !all_known || (!is_whole() && may_grow());
}

bool MaterialLayer::has_columns() const {
    return std::all_of(shown_.begin(), shown_.end(),
                       [](const auto& work) { return work->has_columns(); });
}

bool MaterialLayer::is_whole() const {
    return std::all_of(shown_.begin(), shown_.end(),
                       [](const auto& work) { return work->is_whole(); });
}

bool MaterialLayer::work_a_batch() {
    const auto unknown = std::find_if(shown_.begin(), shown_.end(),
                                      [](const auto& work) { return !work->is_known(); });
    if (unknown != shown_.end()) {
        return (*unknown)->glance(light_);
    }
    const auto unfinished = std::find_if(shown_.begin(), shown_.end(),
                                         [](const auto& work) { return !work->is_whole(); });
    const bool changed = (*unfinished)->estimate(*light_, errors_);
    if (is_whole()) {
        errors_.learn();
    }
    forget_what_does_not_fit();
    return changed;
}

bool MaterialLayer::advance(double milliseconds) {
    const timing::Stopwatch stopwatch;
    bool changed = false;
    for (const auto& work : shown_) {
        changed = work->apply_columns() || changed;
    }
    while (has_work()) {
        changed = work_a_batch() || changed;
        if (stopwatch.milliseconds() >= milliseconds) {
            break;
        }
    }
    awaits_first_look_ =
        awaits_first_look_ && std::any_of(shown_.begin(), shown_.end(),
                                          [](const auto& work) { return !work->is_known(); });
    return changed;
}

std::size_t MaterialLayer::tiles_to_come() const {
    std::size_t sum = 0;
    for (const auto& work : shown_) {
        sum += work->tiles_to_come();
    }
    return sum;
}

double MaterialLayer::error() const {
    double sum = 0;
    for (const auto& work : shown_) {
        sum += work->squared_error(errors_);
    }
    return std::sqrt(sum);
}

std::size_t MaterialLayer::bytes() const {
    return bytes_of(shown_) + bytes_of(kept_);
}

void MaterialLayer::add_to_tile(std::uint32_t tile,
                                float* first,
                                std::size_t row_floats) const {
    for (const auto& work : shown_) {
        const TileChange* const change = work->change(tile);
        if (change == nullptr) {
            continue;
        }
        for (std::size_t i = 0; i < change->slots.size(); ++i) {
            const std::size_t slot = change->slots[i];
            float* const pixel = first + slot / transport::kTileSide * row_floats +
                                 3 * (slot % transport::kTileSide);
            for (std::size_t c = 0; c < 3; ++c) {
                pixel[c] += change->rgb[3 * i + c];
            }
        }
    }
}

}  // namespace relume::materials
