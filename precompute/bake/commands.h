// What relume-bake does when asked.
#pragma once

#include "precompute/bake/command_line.h"

namespace relume::bake {

// Runs the subcommand that was parsed, or bakes. Returns the exit status. Throws BakeError,
// BakeInterrupted and what the libraries below throw.
int run_command(const CLI::App& app, const Arguments& arguments);

}  // namespace relume::bake
