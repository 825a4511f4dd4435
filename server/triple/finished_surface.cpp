#include "server/triple/finished_surface.h"

#include "protocol/base/timing/stopwatch.h"

#include <algorithm>
#include <utility>

namespace relume::triple {

void FinishedSurface::set_finishes(Finishes finishes) {
    for (const auto& [material, finish] : finishes) {
        const auto known = finishes_.find(material);
        if (known == finishes_.end() || known->second != finish) {
            session_.set_material(material, finish);
        }
    }
    const bool are_the_same_parts = std::equal(
        finishes.begin(), finishes.end(), finishes_.begin(), finishes_.end(),
        [](const auto& a, const auto& b) { return a.first == b.first; });
    if (!are_the_same_parts) {
        ++materials_version_;
    }
    finishes_ = std::move(finishes);
    ++radiance_version_;
    worked_milliseconds_ = 0;
}

void FinishedSurface::set_light(const light::LightCubemap& cubemap) {
    session_.set_light(cubemap.planes());
    worked_milliseconds_ = 0;
}

void FinishedSurface::set_view(const Imath::V3f& eye, const view::SeenVertices& seen) {
    session_.set_view(eye, seen.vertices, seen.pixels);
    worked_milliseconds_ = 0;
}

bool FinishedSurface::advance(double milliseconds) {
    const timing::Stopwatch watch;
    const bool has_changed = session_.advance(milliseconds);
    worked_milliseconds_ += 1e3 * watch.seconds();
    if (has_changed) {
        ++radiance_version_;
    }
    return has_changed;
}

}  // namespace relume::triple
