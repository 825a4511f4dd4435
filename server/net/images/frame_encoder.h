// Pictures to the bytes that go over the wire.
#pragma once

#include "protocol/wire/half_image.h"
#include "server/net/base/metrics.h"
#include "server/net/images/image_frame.h"
#include "server/net/images/jpeg_encoder.h"
#include "server/net/images/picture.h"

#include <cstdint>
#include <vector>

namespace relume::net {

// Keeps its buffers between images. Not thread-safe.
class FrameEncoder {
  public:
    explicit FrameEncoder(Metrics& metrics) : metrics_(metrics) {}

    // Encodes the picture in each of its forms. Throws std::runtime_error naming what the codec
    // said.
    [[nodiscard]] ImageFrames encode(const Picture& picture);

  private:
    // `append` adds the payload to the bytes.
    template <typename Append>
    [[nodiscard]] SharedImageFrame frame_of(const Picture& picture,
                                            wire::ImageEncoding encoding,
                                            const Append& append);

    Metrics& metrics_;
    JpegEncoder jpeg_;
    wire::HalfImageEncoder half_;
};

}  // namespace relume::net
