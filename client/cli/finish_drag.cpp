#include "client/cli/finish_drag.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace relume::cli {
namespace {

using nlohmann::json;

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// About the axis that is up in most scenes.
Imath::V3d turned(const Imath::V3d& v, double degrees) {
    const double c = std::cos(degrees * kRadiansPerDegree);
    const double s = std::sin(degrees * kRadiansPerDegree);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

}  // namespace

FinishDrag::FinishDrag(const wire::SceneSummary& scene,
                       std::vector<wire::OfferedMaterial> materials,
                       std::uint64_t seed)
    : parts_(scene.parts),
      camera_(scene.camera.value()),
      centre_(scene.bounds.value().centre),
      materials_(std::move(materials)),
      random_(seed) {}

std::size_t FinishDrag::one_of(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
}

json FinishDrag::finish_at(double way) const {
    const wire::OfferedMaterial& material = materials_[material_];
    json finish = {{"material", material.name}};
    if (material.parameter) {
        finish["parameter"] =
            std::clamp(material.steps.front() *
                           std::pow(material.steps.back() / material.steps.front(), way),
                       material.steps.front(), material.steps.back());
    }
    for (const Imath::V3d& colour : material.colours) {
        const Imath::V3d darker = colour * (1 - way / 2);
        finish["colours"].push_back({darker.x, darker.y, darker.z});
    }
    return finish;
}

json FinishDrag::next() {
    const std::uint32_t edit = edits_++ % kEditsPerMaterial;
    if (edit == 0) {
        part_ = one_of(parts_.size());
        material_ = one_of(materials_.size());
    }
    const double degrees = kDegreesPerEdit * edits_;
    const Imath::V3d eye = centre_ + turned(camera_.eye - centre_, degrees);
    const Imath::V3d look_at = centre_ + turned(camera_.look_at - centre_, degrees);
    return {
        {"rotation", {{"yaw_degrees", degrees}}},
        {"camera",
         {{"eye", {eye.x, eye.y, eye.z}}, {"look_at", {look_at.x, look_at.y, look_at.z}}}},
        {"finishes",
         {{parts_[part_].id, finish_at(static_cast<double>(edit) / (kEditsPerMaterial - 1))}}}};
}

std::vector<wire::OfferedMaterial> materials_for(
    const wire::SceneSummary& scene, const std::vector<wire::OfferedMaterial>& offered) {
    std::vector<wire::OfferedMaterial> fitting;
    if (scene.parts.empty() || !scene.camera || !scene.bounds) {
        return fitting;
    }
    std::copy_if(offered.begin(), offered.end(), std::back_inserter(fitting),
                 [&](const wire::OfferedMaterial& material) {
                     return material.face_resolution == scene.visibility_resolution;
                 });
    return fitting;
}

}  // namespace relume::cli
