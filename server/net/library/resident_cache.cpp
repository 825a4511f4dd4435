#include "server/net/library/resident_cache.h"

#include <algorithm>
#include <utility>

namespace relume::net {

void ResidentCache::keep(std::shared_ptr<const void> object, std::size_t bytes) {
    std::list<Resident> released;  // dies after the lock
    const std::lock_guard lock(mutex_);
    const auto known =
        std::find_if(residents_.begin(), residents_.end(),
                     [&](const Resident& resident) { return resident.object == object; });
    if (known != residents_.end()) {
        residents_.splice(residents_.begin(), residents_, known);
        return;
    }
    if (bytes > max_bytes_) {
        return;
    }
    while (bytes_ + bytes > max_bytes_) {
        bytes_ -= residents_.back().bytes;
        released.splice(released.end(), residents_, std::prev(residents_.end()));
    }
    bytes_ += bytes;
    residents_.push_front({.object = std::move(object), .bytes = bytes});
}

std::size_t ResidentCache::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

}  // namespace relume::net
