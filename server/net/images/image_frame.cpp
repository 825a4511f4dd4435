#include "server/net/images/image_frame.h"

#include <algorithm>

namespace relume::net {

SharedImageFrame restamped(const ImageFrame& frame, const ImageStamp& stamp) {
    auto again = std::make_shared<ImageFrame>(frame);
    wire::ImageHeader& header = again->header;
    header.revision = stamp.revision;
    header.sequence = stamp.sequence;
    header.edit_to_image_ms =
        static_cast<float>(milliseconds(Clock::now() - stamp.edit_read_at));
    header.relight_ms = 0;
    header.encode_ms = 0;
    header.coefficients_applied = 0;
    const auto bytes = wire::encode_image_header(header);
    std::copy(bytes.begin(), bytes.end(), again->bytes.begin());
    again->settled = stamp.settled;
    return again;
}

SharedImageFrame ImageFrames::for_viewer(ImageInterest interest,
                                         const wire::DisplayChoice& display) const {
    if (settled || interest == ImageInterest::moving_float) {
        return half_planes;
    }
    if (interest == ImageInterest::settled || jpegs.empty()) {
        return nullptr;
    }
    const auto of_display = [&](const wire::DisplayChoice& wanted) {
        return std::find_if(jpegs.begin(), jpegs.end(),
                            [&](const Jpeg& jpeg) { return jpeg.display == wanted; });
    };
    auto found = of_display(display);
    if (found == jpegs.end()) {
        found = of_display({});
    }
    return found == jpegs.end() ? jpegs.front().frame : found->frame;
}

}  // namespace relume::net
