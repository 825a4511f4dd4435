// Which instruction set the kernels run on.
#pragma once

#include <string>

namespace relume::engine {

// Honours the environment variable RELUME_FORCE_TARGET (scalar, ssse3, avx2, avx3 or
// neon): called by each kernel's dispatcher once, at its first use. Throws
// std::runtime_error when the name is unknown or the processor lacks it.
void apply_forced_target();

// True when RELUME_FORCE_TARGET is "scalar": the specification runs instead of Highway.
[[nodiscard]] bool scalar_is_forced();

// Name of the target in use, for logs and benchmarks.
[[nodiscard]] std::string target_name();

}  // namespace relume::engine
