// Pictures as a room of the server makes them, without the room: put together, developed, and
// encoded beside whatever its owner does next.
#pragma once

#include "protocol/light/light_rig.h"
#include "server/net/images/display_table.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/jpeg_encoder.h"
#include "server/net/images/sky_pixels.h"
#include "server/view/view.h"

#include <tbb/task_group.h>

#include <cstddef>
#include <memory>
#include <span>

namespace relume::test {

// Not thread-safe. Encodes in the arena of the caller.
class PictureMaker {
  public:
    // `sky`: of the view as it is; null where it moves.
    explicit PictureMaker(std::unique_ptr<view::View> view,
                          std::shared_ptr<const net::SkyPixels> sky = nullptr);
    PictureMaker(const PictureMaker&) = delete;
    PictureMaker& operator=(const PictureMaker&) = delete;
    PictureMaker(PictureMaker&&) = delete;
    PictureMaker& operator=(PictureMaker&&) = delete;
    ~PictureMaker();

    [[nodiscard]] net::FrameComposer& composer() { return composer_; }
    // Waits for the picture before, puts this one together, and begins to encode it.
    void begin(std::span<const float> sums, const light::LightRig& rig);
    // Waits for the last JPEG; its bytes.
    std::size_t finish();

  private:
    net::FrameComposer composer_;
    net::DisplayTable display_;
    net::JpegEncoder jpeg_;
    std::size_t jpeg_bytes_ = 0;
    tbb::task_group encoding_;
};

}  // namespace relume::test
