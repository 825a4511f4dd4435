// From an edit of a curve to JPEG as a room of the server does it, without the room.
#pragma once

#include "protocol/curve/curve.h"
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "server/scene/scene.h"
#include "tests/support/picture_maker.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::lab {

// Of a scene of curves. All materials are as baked, but for the one that is edited. Not
// thread-safe.
class CurveRoom {
  public:
    CurveRoom(std::shared_ptr<const served::Scene> scene,
              relighting::Strategy strategy,
              std::uint32_t material);

    // As baked, of the edited material.
    [[nodiscard]] const curve::Curve& baked() const { return baked_; }
    void set_curve(const curve::Curve& curve);
    // One image's worth of relighting.
    engine::StepReport relight(const relighting::Budget& budget) {
        return session_.advance(budget);
    }
    // The method alone, of so many columns.
    engine::StepReport relight_incrementally(std::uint32_t columns);
    void show() { pictures_.begin(session_.sums(), {}); }
    std::size_t finish() { return pictures_.finish(); }

    [[nodiscard]] const engine::Session& session() const { return session_; }
    [[nodiscard]] const served::Scene& scene() const { return *scene_; }

  private:
    std::shared_ptr<const served::Scene> scene_;
    std::uint32_t material_;
    curve::Curve baked_;
    std::vector<float> signal_;  // planar [3][N]
    engine::Session session_;
    test::PictureMaker pictures_;
};

// ‖a − b‖ / ‖b‖ of sums: blocks are in orthonormal bases, so that it is the error of the
// images where tints are 1.
[[nodiscard]] double relative_error(std::span<const float> a, std::span<const float> b);

}  // namespace relume::lab
