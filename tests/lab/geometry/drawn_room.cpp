#include "tests/lab/geometry/drawn_room.h"

#include "tests/lab/geometry/orbit.h"

#include <Imath/ImathQuat.h>

#include <numbers>
#include <utility>

namespace relume::lab {
namespace {

constexpr double kStepDegrees = 1.5;
constexpr int kMovingQuality = 80;  // as images that move are sent (server/net/README.md)

view::Look square_look(const served::Scene& scene, std::uint32_t side) {
    view::Look look = scene.beginning();
    look.width = side;
    look.height = side;
    return look;
}

}  // namespace

DrawnRoom::DrawnRoom(std::shared_ptr<const served::Scene> scene,
                     std::shared_ptr<const light::PrefilteredEnvironment> environment,
                     std::uint32_t side)
    : scene_(std::move(scene)),
      session_(scene_->workspace(), relighting::Strategy{}),
      own_view_(scene_->make_view()),
      composer_(scene_->make_view(), nullptr),
      display_(wire::Display{}),
      look_(square_look(*scene_, side)) {
    rig_.environment = std::move(environment);
    move_camera(0);
    turn_light(0);
}

DrawnRoom::~DrawnRoom() {
    encoding_.wait();
}

void DrawnRoom::turn_light(double steps) {
    constexpr double kRadiansPerDegree = std::numbers::pi / 180;
    rig_.rotation.setAxisAngle({0, 1, 0},
                               static_cast<float>(steps * kStepDegrees * kRadiansPerDegree));
    light::evaluate(rig_, scene_->face_resolution(), cubemap_);
    light::lighting_coefficients(cubemap_, scene_->projection(), coefficients_);
    session_.set_target(coefficients_);
}

void DrawnRoom::move_camera(double steps) {
    look_ = orbited(square_look(*scene_, look_.width), steps * kStepDegrees);
    if (composer_.look(look_)) {
        session_.set_block_weights(composer_.block_weights());
        if (!session_.exact()) {
            composer_.sums_have_changed();
        }
    }
}

engine::StepReport DrawnRoom::relight(const relighting::Budget& budget) {
    const engine::StepReport report = session_.advance(budget);
    if (report.image_changed) {
        composer_.sums_have_changed();
    }
    return report;
}

void DrawnRoom::show() {
    encoding_.wait();
    composer_.set_background(wire::Background{}, rig_);
    const net::DisplayTable* const display = &display_;
    composer_.compose(session_.sums(), {&display, 1}, false);
    encoding_.run([this] {
        jpeg_bytes_ =
            jpeg_.encode(composer_.codes(0), look_.width, look_.height, kMovingQuality).size();
    });
}

std::size_t DrawnRoom::finish() {
    encoding_.wait();
    return jpeg_bytes_;
}

std::vector<float> DrawnRoom::linear_image() {
    own_view_->look(look_);
    std::vector<float> rgb(std::size_t{3} * look_.width * look_.height);
    own_view_->sums_have_changed();
    view::write_image(*own_view_, session_.sums(), rgb);
    return rgb;
}

}  // namespace relume::lab
