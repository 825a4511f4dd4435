// Image files from strangers, decoded in a child process that can do nothing but compute.
//
// Decoders of EXR have had memory errors and will have more. The child (relume-decode) gets the
// bytes on its standard input, drops every right by rlimits and a seccomp allow-list before it
// looks at them, and answers with plain floats, whose every length this side checks again.
#pragma once

#include "protocol/light/environment_import.h"
#include "protocol/light/environment_map.h"
#include "protocol/light/projection.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>

namespace relume::decoder {

struct DecodeLimits {
    std::size_t max_file_bytes = std::size_t{64} << 20;
    // A map keeps 16 bytes a texel in the server: who takes many uploads will want this lower.
    // The lower of this and of what the options allow counts.
    std::size_t max_texels = light::kMaxMapTexels;
    std::size_t address_space_bytes = std::size_t{6} << 30;
    std::chrono::milliseconds timeout{30'000};  // wall clock; CPU time is bounded by the same
    // When it is asked to stop, the child is ended within a twentieth of a second.
    std::stop_token stop;
    // Empty: `relume-decode` beside the running program.
    std::filesystem::path program;
};

// As import_environment, in a child. May be called from any thread, and from several at once;
// the calling thread waits. Throws EnvironmentError when the file is refused, and also when the
// child cannot be started, crashes, is stopped for a forbidden system call, runs out of time or
// answers nonsense; the message says which.
[[nodiscard]] light::ImportedEnvironment decode_in_child(
    std::span<const std::byte> file_bytes,
    const light::ImportOptions& options = {},
    const DecodeLimits& limits = {});

}  // namespace relume::decoder
