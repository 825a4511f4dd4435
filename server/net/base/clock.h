// The clock of everything the server times: monotonic, whatever the wall clock does.
#pragma once

#include <chrono>

namespace relume::net {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double milliseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}
[[nodiscard]] inline Clock::duration from_milliseconds(double duration) {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double, std::milli>(duration));
}
[[nodiscard]] inline double seconds(Clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

}  // namespace relume::net
