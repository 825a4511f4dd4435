// From light to JPEG as a room of the server does it, without the room.
#pragma once

#include "protocol/relighting/budget.h"
#include "server/engine/session.h"
#include "server/net/images/display_table.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/jpeg_encoder.h"
#include "server/net/images/sky_pixels.h"
#include "tests/bench/light_drag.h"

#include <tbb/task_group.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::bench {

// The tone map and JPEG of one image run beside the relighting of the next, in the arena of the
// caller. Not thread-safe.
class ImagePipeline {
  public:
    explicit ImagePipeline(std::shared_ptr<const served::Scene> scene);
    ImagePipeline(const ImagePipeline&) = delete;
    ImagePipeline& operator=(const ImagePipeline&) = delete;
    ImagePipeline(ImagePipeline&&) = delete;
    ImagePipeline& operator=(ImagePipeline&&) = delete;
    ~ImagePipeline();

    // Image `number` of the drag is what the session is to show from now on.
    void turn_light(std::size_t number);
    // One step within the budget.
    engine::StepReport advance(const relighting::Budget& budget) {
        return session_.advance(budget);
    }
    [[nodiscard]] bool exact() const { return session_.exact(); }
    // Waits for the image before, puts this one together and begins to encode it.
    void begin_encoding();
    // Waits for the last JPEG; its bytes.
    std::size_t finish_encoding();

  private:
    // As images that move are sent (server/net/README.md).
    static constexpr int kMovingQuality = 80;

    std::shared_ptr<const served::Scene> scene_;
    LightDrag drag_;
    engine::Session session_;
    net::FrameComposer composer_;
    net::DisplayTable display_;
    net::JpegEncoder jpeg_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
    std::size_t jpeg_bytes_ = 0;
    tbb::task_group encoding_;
};

}  // namespace relume::bench
