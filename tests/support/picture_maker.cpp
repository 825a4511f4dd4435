#include "tests/support/picture_maker.h"

#include <utility>

namespace relume::test {
namespace {

constexpr int kMovingQuality = 80;  // as images that move are sent (server/net/README.md)

}  // namespace

PictureMaker::PictureMaker(std::unique_ptr<view::View> view,
                           std::shared_ptr<const net::SkyPixels> sky)
    : composer_(std::move(view), std::move(sky)), display_(wire::Display{}) {}

PictureMaker::~PictureMaker() {
    encoding_.wait();
}

void PictureMaker::begin(std::span<const float> sums, const light::LightRig& rig) {
    encoding_.wait();
    composer_.set_background(wire::Background{}, rig);
    const net::DisplayTable* const display = &display_;
    composer_.compose(sums, {&display, 1}, false);
    encoding_.run([this] {
        jpeg_bytes_ = jpeg_
                          .encode(composer_.codes(0), composer_.width(), composer_.height(),
                                  kMovingQuality)
                          .size();
    });
}

std::size_t PictureMaker::finish() {
    encoding_.wait();
    return jpeg_bytes_;
}

}  // namespace relume::test
