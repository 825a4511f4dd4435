#include "server/net/images/image_frame.h"

#include <algorithm>

namespace relume::net {

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
