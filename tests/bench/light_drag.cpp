#include "tests/bench/light_drag.h"

#include "protocol/light/procedural_environment.h"

#include <algorithm>
#include <numbers>
#include <set>

namespace relume::bench {
namespace {

using transport::kColours;

// The columns that matter most, of those that differ.
std::vector<std::uint32_t> most_important(const served::Scene& scene,
                                          std::span<const float> target,
                                          std::span<const float> shown,
                                          std::size_t terms) {
    struct Candidate {
        float importance;
        std::uint32_t column;
    };
    const std::size_t count = scene.columns().count();
    std::vector<Candidate> candidates;
    for (std::uint32_t j = 0; j < count; ++j) {
        float importance = 0;
        for (std::uint32_t c = 0; c < kColours; ++c) {
            const float change = target[c * count + j] - shown[c * count + j];
            importance += change * change * scene.transport().energy(j, c);
        }
        if (importance > 0) {
            candidates.push_back({importance, j});
        }
    }
    const std::size_t taken = std::min(terms, candidates.size());
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(taken);
    std::partial_sort(
        candidates.begin(), end, candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.importance > b.importance; });
    std::vector<std::uint32_t> columns;
    std::transform(candidates.begin(), end, std::back_inserter(columns),
                   [](const Candidate& candidate) { return candidate.column; });
    const auto bands = scene.columns().bands();
    std::sort(columns.begin(), columns.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(bands[a], a) < std::pair(bands[b], b);
    });
    return columns;
}

}  // namespace

LightDrag::LightDrag(std::uint32_t face_resolution)
    : projection_(basis::CubemapProjection::onto(basis::CubemapBasis::haar(face_resolution))),
      environment_(std::make_shared<const light::PrefilteredEnvironment>(
          std::make_shared<const light::EnvironmentMap>(
              light::procedural_environment("sky-afternoon")),
          face_resolution)) {}

light::LightRig LightDrag::rig(std::size_t image) const {
    constexpr double kDegreesPerImage = 1.5;
    light::LightRig rig;
    rig.environment = environment_;
    const double degrees = kDegreesPerImage * static_cast<double>(image);
    rig.rotation.setAxisAngle(Imath::V3f(0, 1, 0),
                              static_cast<float>(degrees * std::numbers::pi / 180));
    return rig;
}

std::vector<float> LightDrag::lighting(std::size_t image) const {
    light::LightCubemap cubemap;
    light::evaluate(rig(image), projection_->basis().face_resolution(), cubemap);
    std::vector<float> coefficients;
    light::lighting_coefficients(cubemap, *projection_, coefficients);
    return coefficients;
}

std::vector<ChangesOfImage> drag_changes(const served::Scene& scene,
                                         std::size_t terms,
                                         std::size_t images) {
    const LightDrag drag(scene.face_resolution());
    const std::size_t count = scene.columns().count();
    std::vector<float> shown(kColours * count);
    std::vector<ChangesOfImage> changes(images);
    for (std::size_t image = 0; image < images; ++image) {
        const std::vector<float> target = drag.lighting(image);
        for (const std::uint32_t j : most_important(scene, target, shown, terms)) {
            engine::ColumnChange change{.column = j};
            for (std::size_t c = 0; c < kColours; ++c) {
                change.from[c] = shown[c * count + j];
                change.to[c] = shown[c * count + j] = target[c * count + j];
            }
            changes[image].push_back(change);
        }
    }
    return changes;
}

std::vector<std::uint32_t> columns_of(std::span<const ChangesOfImage> images) {
    std::set<std::uint32_t> columns;
    for (const ChangesOfImage& image : images) {
        for (const engine::ColumnChange& change : image) {
            columns.insert(change.column);
        }
    }
    return {columns.begin(), columns.end()};
}

std::uint64_t bytes_of(const served::Scene& scene, const ChangesOfImage& image) {
    std::uint64_t bytes = 0;
    for (const engine::ColumnChange& change : image) {
        bytes += scene.columns().bytes(change.column);
    }
    return bytes;
}

}  // namespace relume::bench
