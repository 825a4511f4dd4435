// From light to JPEG as a room of the server does it, without the room.
#pragma once

#include "protocol/relighting/budget.h"
#include "server/engine/session.h"
#include "tests/bench/light_drag.h"
#include "tests/support/picture_maker.h"

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

    // Image `number` of the drag is what the session is to show from now on.
    void turn_light(std::size_t number);
    // One step within the budget.
    engine::StepReport advance(const relighting::Budget& budget) {
        return session_.advance(budget);
    }
    [[nodiscard]] bool exact() const { return session_.exact(); }
    // Waits for the image before, puts this one together and begins to encode it.
    void begin_encoding() { pictures_.begin(session_.sums(), rig_); }
    // Waits for the last JPEG; its bytes.
    std::size_t finish_encoding() { return pictures_.finish(); }

  private:
    std::shared_ptr<const served::Scene> scene_;
    LightDrag drag_;
    engine::Session session_;
    test::PictureMaker pictures_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
};

}  // namespace relume::bench
