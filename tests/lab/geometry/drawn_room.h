// From an edit of light and camera to JPEG as a room of the server does it, without the room.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"
#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/session.h"
#include "server/net/images/display_table.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/jpeg_encoder.h"
#include "server/scene/scene.h"

#include <tbb/task_group.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::lab {

// The camera goes around what the scene's own camera looks at, the light turns about the
// vertical; both by a number of steps of one degree and a half. The JPEG of one image is made
// beside the relighting of the next. Not thread-safe.
class DrawnRoom {
  public:
    // Images are side×side pixels.
    DrawnRoom(std::shared_ptr<const served::Scene> scene,
              std::shared_ptr<const light::PrefilteredEnvironment> environment,
              std::uint32_t side);
    DrawnRoom(const DrawnRoom&) = delete;
    DrawnRoom& operator=(const DrawnRoom&) = delete;
    DrawnRoom(DrawnRoom&&) = delete;
    DrawnRoom& operator=(DrawnRoom&&) = delete;
    ~DrawnRoom();

    void turn_light(double steps);
    void move_camera(double steps);
    // One image's worth of relighting, and what it did.
    engine::StepReport relight(const relighting::Budget& budget);
    // Waits for the JPEG before, puts the picture together and begins to encode it.
    void show();
    // Waits for the last JPEG; its bytes.
    std::size_t finish();

    [[nodiscard]] const engine::Session& session() const { return session_; }
    // The image without what lies behind, of the sums as they are.
    [[nodiscard]] std::vector<float> linear_image();

  private:
    std::shared_ptr<const served::Scene> scene_;
    light::LightRig rig_;
    engine::Session session_;
    std::unique_ptr<view::View> own_view_;  // for linear images
    net::FrameComposer composer_;
    net::DisplayTable display_;
    net::JpegEncoder jpeg_;
    view::Look look_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
    std::size_t jpeg_bytes_ = 0;
    tbb::task_group encoding_;
};

}  // namespace relume::lab
