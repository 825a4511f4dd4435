#include "server/net/rooms/finish_layer.h"

#include "protocol/wire/json_text.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace relume::net {
namespace {

std::optional<std::vector<Imath::V3f>> colours_of(const wire::Finish& finish) {
    if (!finish.colours) {
        return std::nullopt;
    }
    std::vector<Imath::V3f> colours;
    const std::vector<double>& numbers = finish.colours->numbers;
    for (std::size_t row = 0; row < finish.colours->rows(); ++row) {
        colours.emplace_back(
            Imath::V3d(numbers[3 * row], numbers[3 * row + 1], numbers[3 * row + 2]));
    }
    return colours;
}

}  // namespace

FinishLayer::FinishLayer(std::shared_ptr<const served::Scene> scene)
    : scene_(std::move(scene)), surface_(scene_->lit_surface()) {}

std::unique_ptr<view::View> FinishLayer::make_view() {
    return scene_->make_view(&surface_);
}

triple::FinishedSurface::Finishes FinishLayer::shown(
    const NamedFinishes& finishes, std::vector<wire::ErrorMessage>& problems) const {
    triple::FinishedSurface::Finishes shown;
    const std::span<const served::ScenePart> parts = scene_->parts();
    // Materials that no vertex has are beyond those of the surface, and nothing shows them.
    const std::uint32_t count = std::min(static_cast<std::uint32_t>(parts.size()),
                                         scene_->lit_surface()->material_count());
    for (std::uint32_t part = 0; part < count; ++part) {
        const auto edit = edits_.find(parts[part].id);
        const auto family = finishes.find(parts[part].id);
        if (edit == edits_.end() || family == finishes.end()) {
            continue;
        }
        try {
            shown.emplace(
                part, family->second->finish(edit->second.parameter, colours_of(edit->second)));
        } catch (const std::exception& failure) {
            problems.push_back(
                {.code = wire::ErrorCode::unsupported,
                 .message = "the material cannot be read, and the part stays as it was",
                 .path = wire::pointer_step("/finishes", parts[part].id),
                 .found = failure.what(),
                 .expected = "a file of a material",
                 .edit_id = {}});
            if (const auto before = surface_.finishes().find(part);
                before != surface_.finishes().end()) {
                shown.insert(*before);
            }
        }
    }
    return shown;
}

RoomLayer::Change FinishLayer::set_state(const wire::RoomState& state,
                                         const NamedFinishes& finishes,
                                         RoomSignal& signal,
                                         bool light_is_new,
                                         std::vector<wire::ErrorMessage>& problems) {
    light_is_new_ = light_is_new_ || light_is_new;
    Change change;
    if (state.finishes != edits_ || finishes != families_) {
        edits_ = state.finishes;
        families_ = finishes;
        const std::uint64_t parts_before = surface_.materials_version();
        surface_.set_finishes(shown(finishes, problems));
        change = {.pixels = true, .parts = surface_.materials_version() != parts_before};
    }
    if (light_is_new_ && !surface_.finishes().empty()) {
        surface_.set_light(*signal.cubemap(scene_->lit_surface()->face_resolution()));
        light_is_new_ = false;
        change.pixels = true;
    }
    return change;
}

void FinishLayer::set_view(const view::View& view) {
    if (surface_.finishes().empty()) {
        shows_transport_ = true;
        surface_.set_view(view.camera().eye, {});
        return;
    }
    const view::SeenVertices seen = view.seen_vertices();
    shows_transport_ = seen.shows_others || seen.vertices.empty();
    surface_.set_view(view.camera().eye, seen);
}

double FinishLayer::stated_error(double of_transport, double /*transport_norm*/) const {
    const double of_finishes = surface_.stated_error();
    return shows_transport_ ? std::max(of_transport, of_finishes) : of_finishes;
}

}  // namespace relume::net
