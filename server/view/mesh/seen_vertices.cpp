#include "server/view/mesh/seen_vertices.h"

#include "server/view/mesh/corner_counts.h"

namespace relume::view {

SeenVertices seen_vertices(const DrawnSurface& surface,
                           const VisibleSurface& visible,
                           const GivenRadiance& given) {
    const CornerCounts places =
        corner_counts(surface.mesh(), visible, surface.mesh().vertex_count(),
                      [](std::uint32_t vertex) { return vertex; });
    SeenVertices seen{.vertices = {}, .pixels = {}, .shows_others = false};
    for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
        if (places[vertex] == 0) {
            continue;
        }
        if (!given.is_given(surface.material_of(vertex))) {
            seen.shows_others = true;
            continue;
        }
        seen.vertices.push_back(vertex);
        seen.pixels.push_back(pixels_from_places(places[vertex]));
    }
    return seen;
}

}  // namespace relume::view
