// Giving up every right a decoder does not need. Internal to server/light.
#pragma once

#include <cstddef>

namespace relume::light {

struct SandboxLimits {
    std::size_t address_space_bytes = 0;
    unsigned cpu_seconds = 0;
};

// From here on this process, all its threads included, may compute, allocate memory, read
// descriptor 0, write descriptors 1 and 2, and end; any other system call ends it with SIGSYS.
// It dies with its parent. Cannot be undone. Throws std::system_error if the kernel refuses any
// part of it.
void enter_sandbox(const SandboxLimits& limits);

}  // namespace relume::light
