// Keeps alive what was used last, within a bound of bytes.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>

namespace relume::net {

// Holds shared pointers only so that their objects survive between two uses. Who uses an object
// holds it as well, so that nobody loses it when the cache lets go. Thread-safe.
class ResidentCache {
  public:
    explicit ResidentCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // Keeps the object, now the one used last, and lets go of the longest unused ones until
    // all fit. One larger than the bound is not kept.
    void keep(std::shared_ptr<const void> object, std::size_t bytes);
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Resident {
        std::shared_ptr<const void> object;
        std::size_t bytes;
    };

    const std::size_t max_bytes_;
    mutable std::mutex mutex_;
    std::list<Resident> residents_;  // the one used last in front
    std::size_t bytes_ = 0;
};

}  // namespace relume::net
