// Where log lines go: standard error, whoever reads it or does not.
#pragma once

#include <spdlog/sinks/sink.h>

#include <cstdint>
#include <memory>

namespace relume::net {

// Lines wait in a bounded queue for a thread of their own, so that nobody else ever waits for a
// pipe that is full; beyond it they are dropped and counted. When the sink dies, what waits is
// written if that takes no longer than a moment.
[[nodiscard]] std::shared_ptr<spdlog::sinks::sink> make_log_sink(int descriptor);

// Lines that no sink of this process could keep.
[[nodiscard]] std::uint64_t dropped_log_lines();

}  // namespace relume::net
