#include "tests/lab/methods/image_maker.h"

namespace relume::lab {

std::uint64_t ViewImageMaker::take(std::span<const float> sums) {
    sums_ = sums;
    view_->sums_have_changed();
    view_->begin_image(sums);
    return 0;
}

}  // namespace relume::lab
