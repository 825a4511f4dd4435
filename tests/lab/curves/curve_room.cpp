#include "tests/lab/curves/curve_room.h"

#include "protocol/basis/curve_projection.h"

#include <cmath>
#include <limits>
#include <utility>

namespace relume::lab {

CurveRoom::CurveRoom(std::shared_ptr<const served::Scene> scene,
                     relighting::Strategy strategy,
                     std::uint32_t material)
    : scene_(std::move(scene)),
      material_(material),
      baked_{scene_->curves()[material].baked},
      session_(scene_->workspace(), strategy),
      pictures_(scene_->make_view()) {
    const basis::CurveBasis& basis = scene_->transport().manifest().signal_basis.curves();
    const std::size_t count = basis.coefficient_count();
    signal_.assign(3 * count, 0.0F);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::span<float> plane = std::span(signal_).subspan(channel * count, count);
        basis::project_rest(plane);
        for (std::uint32_t m = 0; m < basis.curve_count(); ++m) {
            basis::project_curve(basis, m, 1, scene_->curves()[m].baked[channel], plane);
        }
    }
    session_.set_target(signal_);
}

void CurveRoom::set_curve(const curve::Curve& curve) {
    const basis::CurveBasis& basis = scene_->transport().manifest().signal_basis.curves();
    const std::size_t count = basis.coefficient_count();
    for (std::size_t channel = 0; channel < 3; ++channel) {
        basis::project_curve(basis, material_, 1, curve.rgb[channel],
                             std::span(signal_).subspan(channel * count, count));
    }
    session_.set_target(signal_);
}

engine::StepReport CurveRoom::relight_incrementally(std::uint32_t columns) {
    return session_.advance_incrementally(
        {.columns = columns, .bytes = std::numeric_limits<std::uint64_t>::max()});
}

double relative_error(std::span<const float> a, std::span<const float> b) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        difference += std::pow(double{a[i]} - double{b[i]}, 2);
        norm += std::pow(double{b[i]}, 2);
    }
    return norm > 0 ? std::sqrt(difference / norm) : 0;
}

}  // namespace relume::lab
