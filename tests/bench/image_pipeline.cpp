#include "tests/bench/image_pipeline.h"

#include "protocol/relighting/strategy.h"

#include <utility>

namespace relume::bench {

ImagePipeline::ImagePipeline(std::shared_ptr<const served::Scene> scene)
    : scene_(std::move(scene)),
      drag_(scene_->face_resolution()),
      session_(scene_->workspace(), relighting::Strategy{}),
      composer_(scene_->make_view(),
                std::make_shared<const net::SkyPixels>(*scene_->make_view())),
      display_(wire::Display{}) {}

ImagePipeline::~ImagePipeline() {
    encoding_.wait();
}

void ImagePipeline::turn_light(std::size_t number) {
    rig_ = drag_.rig(number);
    light::evaluate(rig_, scene_->face_resolution(), cubemap_);
    light::lighting_coefficients(cubemap_, scene_->projection(), coefficients_);
    session_.set_target(coefficients_);
}

void ImagePipeline::begin_encoding() {
    encoding_.wait();
    composer_.set_background(wire::Background{}, rig_);
    const net::DisplayTable* const display = &display_;
    composer_.compose(session_.sums(), {&display, 1}, false);
    encoding_.run([this] {
        jpeg_bytes_ = jpeg_
                          .encode(composer_.codes(0), scene_->image().width,
                                  scene_->image().height, kMovingQuality)
                          .size();
    });
}

std::size_t ImagePipeline::finish_encoding() {
    encoding_.wait();
    return jpeg_bytes_;
}

}  // namespace relume::bench
