#include "server/net/images/frame_encoder.h"

#include "server/net/base/clock.h"
#include "server/net/images/frame_composer.h"

#include <algorithm>

namespace relume::net {

template <typename Append>
SharedImageFrame FrameEncoder::frame_of(const Picture& picture,
                                        wire::ImageEncoding encoding,
                                        const Append& append) {
    const Clock::time_point begin = Clock::now();
    auto frame = std::make_shared<ImageFrame>();
    frame->settled = picture.settled;
    frame->bytes.resize(wire::kImageHeaderBytes);
    append(frame->bytes);
    const Clock::duration taken = Clock::now() - begin;
    frame->header = picture.header;
    frame->header.encoding = encoding;
    frame->header.has_alpha = encoding == wire::ImageEncoding::half_planes && picture.has_alpha;
    frame->header.encode_ms = static_cast<float>(milliseconds(taken));
    frame->header.payload_bytes =
        static_cast<std::uint32_t>(frame->bytes.size() - wire::kImageHeaderBytes);
    const auto header = wire::encode_image_header(frame->header);
    std::copy(header.begin(), header.end(), frame->bytes.begin());
    metrics_.count_image(encoding, frame->bytes.size(), seconds(taken));
    return frame;
}

ImageFrames FrameEncoder::encode(const Picture& picture) {
    ImageFrames frames;
    frames.settled = picture.settled;
    for (std::size_t i = 0; i < picture.forms.displays.size(); ++i) {
        auto append = [&](std::vector<std::byte>& bytes) {
            const auto payload = jpeg_.encode(picture.composer->codes(i), picture.header.width,
                                              picture.header.height, picture.jpeg_quality);
            bytes.insert(bytes.end(), payload.begin(), payload.end());
        };
        frames.jpegs.push_back({.display = picture.forms.displays[i],
                                .frame = frame_of(picture, wire::ImageEncoding::jpeg, append)});
    }
    if (picture.forms.half_planes) {
        frames.half_planes = frame_of(
            picture, wire::ImageEncoding::half_planes, [&](std::vector<std::byte>& bytes) {
                half_.append_to(bytes, picture.composer->half_image());
            });
    }
    return frames;
}

}  // namespace relume::net
