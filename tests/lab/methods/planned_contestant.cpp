#include "tests/lab/methods/planned_contestant.h"

#include "tests/lab/methods/light_radiance.h"

#include <utility>

namespace relume::lab {

PlannedContestant::PlannedContestant(std::shared_ptr<const served::Scene> scene,
                                     std::unique_ptr<PlanMaker> plan_maker)
    : scene_(std::move(scene)),
      image_(*scene_),
      plan_maker_(std::move(plan_maker)),
      lighting_(scene_->columns()),
      lit_(scene_->columns()),
      images_(scene_->stored_operator()),
      error_(scene_->columns()) {}

void PlannedContestant::set_light(const ImageLight& light) {
    light::lighting_coefficients(light.radiance, scene_->projection(), target_);
    lighting_.set_target(target_);
}

Step PlannedContestant::step() {
    lit_.set_nearly(lighting_.target(), engine::kSurelyNegligible);
    error_.set_target(lit_);
    plan_maker_->make(*scene_, lighting_, plan_);
    images_.update(plan_.bands_to_reset, plan_.changes);
    lighting_.apply(plan_);
    error_.apply(plan_);
    const std::uint64_t bytes_of_image = image_.take(images_.total());
    return {.applied = static_cast<std::uint32_t>(plan_.changes.size()),
            .bands_reset = plan_.bands_to_reset,
            .bytes = plan_.bytes + bytes_of_image,
            .band_bytes = images_.bytes_of_bands(),
            .stated_error = error_.relative_l2()};
}

LightingView PlannedContestant::lighting() const {
    return {.target = lighting_.target(),
            .approximation = lighting_.approximation(),
            .bands = scene_->columns().bands()};
}

void PlannedContestant::write_radiance(light::LightCubemap& out) const {
    radiance_from_coefficients(lighting_.approximation(), scene_->projection(), out);
}

}  // namespace relume::lab
