#include "protocol/base/text/material_ids.h"

#include "protocol/base/text/names.h"

#include <fmt/format.h>

namespace relume::text {

std::string MaterialIds::next(const std::string& name) {
    constexpr std::size_t kRoomForNumber = 5;
    std::string id = name.substr(0, kMaxNameLength - kRoomForNumber);
    for (char& letter : id) {
        if (!is_name(std::string("a") + letter)) {
            letter = '-';
        }
    }
    if (!is_name(id)) {
        id = ("material" + id).substr(0, kMaxNameLength - kRoomForNumber);
    }
    std::string free = id;
    for (int number = 2; !taken_.insert(free).second; ++number) {
        free = fmt::format("{}-{}", id, number);
    }
    return free;
}

}  // namespace relume::text
