// Waiting for what other threads do. A deadline only ends a test that would hang.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

namespace relume::net {

inline constexpr std::chrono::seconds kDeadline{60};

// True once `holds` does.
[[nodiscard]] inline bool eventually(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + kDeadline;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace relume::net
