#include "tests/bench/image_pipeline.h"

#include "protocol/relighting/strategy.h"

#include <utility>

namespace relume::bench {

ImagePipeline::ImagePipeline(std::shared_ptr<const served::Scene> scene)
    : scene_(std::move(scene)),
      drag_(scene_->face_resolution()),
      session_(scene_->workspace(), relighting::Strategy{}),
      pictures_(scene_->make_view(),
                std::make_shared<const net::SkyPixels>(*scene_->make_view())) {}

void ImagePipeline::turn_light(std::size_t number) {
    rig_ = drag_.rig(number);
    light::evaluate(rig_, scene_->face_resolution(), cubemap_);
    light::lighting_coefficients(cubemap_, scene_->projection(), coefficients_);
    session_.set_target(coefficients_);
}

}  // namespace relume::bench
