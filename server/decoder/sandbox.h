// Giving up every right a decoder does not need. Internal to protocol/light.
#pragma once

#include <cstddef>
#include <functional>

namespace relume::decoder {

struct SandboxLimits {
    std::size_t address_space_bytes = 0;
    unsigned cpu_seconds = 0;
};

// Runs `body` in a fork of this process that may compute, allocate memory, read descriptor 0,
// write descriptors 1 and 2, and end; any other system call ends it with SIGSYS. It dies with
// its parent. This process then ends as the fork did: with what `body` returned, or by the same
// signal.
//
// A fork, because it has one thread: those that libraries start while they load would otherwise
// come under the filter in the middle of whatever they do.
// Throws std::system_error where it cannot fork; this process, too, dies with its parent. If
// the kernel refuses any part of the sandbox, `body` is not run and the status is EXIT_FAILURE.
[[noreturn]] void run_sandboxed(const SandboxLimits& limits, const std::function<int()>& body);

}  // namespace relume::decoder
