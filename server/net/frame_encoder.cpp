#include "server/net/frame_encoder.h"

#include "server/net/clock.h"
#include "server/net/frame_composer.h"

#include <algorithm>

namespace relume::net {

SharedImageFrame FrameEncoder::encode(const Picture& picture) {
    const Clock::time_point begin = Clock::now();
    auto frame = std::make_shared<ImageFrame>();
    frame->bytes.resize(wire::kImageHeaderBytes);
    if (picture.header.encoding == wire::ImageEncoding::jpeg) {
        append_jpeg(picture, frame->bytes);
    } else {
        half_.append_to(frame->bytes, picture.composer->half_image());
    }
    const Clock::duration taken = Clock::now() - begin;
    frame->header = picture.header;
    frame->header.encode_ms = static_cast<float>(milliseconds(taken));
    frame->header.payload_bytes =
        static_cast<std::uint32_t>(frame->bytes.size() - wire::kImageHeaderBytes);
    const auto header = wire::encode_image_header(frame->header);
    std::copy(header.begin(), header.end(), frame->bytes.begin());
    metrics_.count_image(frame->header.encoding, frame->bytes.size(), seconds(taken));
    return frame;
}

void FrameEncoder::append_jpeg(const Picture& picture, std::vector<std::byte>& bytes) {
    const auto payload = jpeg_.encode(picture.composer->codes(), picture.header.width,
                                      picture.header.height, picture.jpeg_quality);
    bytes.insert(bytes.end(), payload.begin(), payload.end());
}

}  // namespace relume::net
