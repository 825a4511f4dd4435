#include "server/net/images/image_forms.h"

#include <algorithm>

namespace relume::net {

void ImageForms::add(const wire::DisplayChoice& display) {
    const auto has = [&](const wire::DisplayChoice& other) {
        return std::find(displays.begin(), displays.end(), other) != displays.end();
    };
    if (has(display)) {
        return;
    }
    if (displays.size() < kMostDisplays) {
        displays.push_back(display);
    } else if (!has({})) {
        displays.back() = {};
    }
}

}  // namespace relume::net
