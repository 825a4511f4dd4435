// Somebody who moves light, camera and materials of a scene all at once, at random, as load.
#pragma once

#include "protocol/wire/offered_material.h"
#include "protocol/wire/scene_summary.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace relume::cli {

// The light turns and the camera goes around the scene, both by kDegreesPerEdit. Every
// kEditsPerMaterial edits another part gets another material, whose number and colours are
// dragged until the next.
class FinishDrag {
  public:
    static constexpr std::uint32_t kEditsPerMaterial = 30;
    static constexpr double kDegreesPerEdit = 1.5;

    // Of a scene with parts, a camera and bounds, and at least one material that its parts may
    // be given. The same seed makes the same edits.
    FinishDrag(const wire::SceneSummary& scene,
               std::vector<wire::OfferedMaterial> materials,
               std::uint64_t seed);

    // The next edit, a patch.
    [[nodiscard]] nlohmann::json next();

  private:
    [[nodiscard]] std::size_t one_of(std::size_t count);
    [[nodiscard]] nlohmann::json finish_at(double way) const;

    std::vector<wire::ScenePart> parts_;
    wire::Camera camera_;
    Imath::V3d centre_;
    std::vector<wire::OfferedMaterial> materials_;
    std::mt19937_64 random_;
    std::uint32_t edits_ = 0;
    std::size_t part_ = 0;
    std::size_t material_ = 0;
};

// Of the materials that are offered, those that parts of the scene may be given.
[[nodiscard]] std::vector<wire::OfferedMaterial> materials_for(
    const wire::SceneSummary& scene, const std::vector<wire::OfferedMaterial>& offered);

}  // namespace relume::cli
