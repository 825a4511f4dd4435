// Pictures to the bytes that go over the wire.
#pragma once

#include "protocol/wire/half_image.h"
#include "server/net/image_frame.h"
#include "server/net/jpeg_encoder.h"
#include "server/net/metrics.h"
#include "server/net/picture.h"

#include <cstdint>
#include <vector>

namespace relume::net {

// Keeps its buffers between images. Not thread-safe.
class FrameEncoder {
  public:
    explicit FrameEncoder(Metrics& metrics) : metrics_(metrics) {}

    // In the encoding that the picture's header names. Throws std::runtime_error naming what
    // the codec said.
    [[nodiscard]] SharedImageFrame encode(const Picture& picture);

  private:
    void append_jpeg(const Picture& picture, std::vector<std::byte>& bytes);

    Metrics& metrics_;
    JpegEncoder jpeg_;
    wire::HalfImageEncoder half_;
};

}  // namespace relume::net
