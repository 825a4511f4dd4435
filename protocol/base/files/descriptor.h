// A file descriptor that is closed with its owner.
#pragma once

#include <unistd.h>

#include <utility>

namespace relume::files {

class Descriptor {
  public:
    Descriptor() = default;
    // Takes the descriptor over; a negative one is none.
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ >= 0) {
            ::close(value_);
        }
    }

    [[nodiscard]] int get() const { return value_; }
    [[nodiscard]] bool is_open() const { return value_ >= 0; }

  private:
    int value_ = -1;
};

}  // namespace relume::files
